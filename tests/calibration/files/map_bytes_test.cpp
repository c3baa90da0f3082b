// Maps and pictures from memory.

#include "calibration/errors.h"
#include "calibration/files/map_file.h"
#include "calibration/files/pfm_file.h"
#include "tests/support/map_writer.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>

namespace curvewall {
namespace {

using ::testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::string complaint(const std::function<void()>& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no complaint";
}

NumberMap ramp(glm::ivec2 sizePx, int channels) {
    NumberMap map{sizePx, channels, false, {}};
    const int count = sizePx.x * sizePx.y * channels;
    for (int i = 0; i < count; ++i) map.values.push_back(static_cast<float>(i) / static_cast<float>(count));
    return map;
}

TEST(MapBytes, PfmIsReadInBothByteOrders) {
    const NumberMap map = ramp({5, 3}, 3);
    for (const bool bigEndian : {false, true}) {
        const NumberMap read = readNumberMap(FileBytes{"a.pfm", test::pfmBytes(map, bigEndian)});
        EXPECT_EQ(read.sizePx, map.sizePx);
        EXPECT_EQ(read.values, map.values) << bigEndian;
    }
}

TEST(MapBytes, APfmWithTheWrongSignOfItsScaleIsRefused) {
    NumberMap map = ramp({8, 8}, 3);
    for (size_t i = 2; i < map.values.size(); i += 3) map.values[i] = kNan;
    for (const bool bigEndian : {false, true}) {
        std::string bytes = test::pfmBytes(map, bigEndian);
        const std::string right = bigEndian ? "\n1.0\n" : "\n-1.0\n",
                          wrong = bigEndian ? "\n-1.0\n" : "\n1.0\n";
        bytes.replace(bytes.find(right), right.size(), wrong);
        EXPECT_THAT(complaint([&] { parsePfm({"a.pfm", bytes}); }), HasSubstr("byte order")) << bigEndian;
    }
}

TEST(MapBytes, ZerosNansAndLargePointsAreNoSignOfAWrongByteOrder) {
    NumberMap map{{2, 2}, 3, false, std::vector<float>(12, 0.0f)};
    EXPECT_NO_THROW(parsePfm({"a.pfm", test::pfmBytes(map)}));
    map.values.assign(12, kNan);
    EXPECT_NO_THROW(parsePfm({"a.pfm", test::pfmBytes(map)}));
    map.values.assign(12, 54321.5f);
    EXPECT_NO_THROW(parsePfm({"a.pfm", test::pfmBytes(map)}));
}

class Pictures : public ::testing::TestWithParam<const char*> {};

TEST_P(Pictures, AreTheSameFromMemoryAndFromADisk) {
    const test::TemporaryFolder folder;
    const std::string path = folder.path(GetParam());
    const bool isFloat = std::string(GetParam()).find("exr") != std::string::npos;
    test::writeMap(path, ramp({7, 5}, 3), isFloat ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8);
    FileBytes file = readFile(path, "a picture");
    const NumberMap fromDisk = readNumberMap(path);
    file.path = "archive.mpcdi!no such file";  // neither the name nor a file of that name is looked at
    const NumberMap fromMemory = readNumberMap(file);
    EXPECT_EQ(fromMemory.sizePx, glm::ivec2(7, 5));
    EXPECT_EQ(fromMemory.values, fromDisk.values);
    EXPECT_EQ(fromMemory.isInteger, fromDisk.isInteger);
}

INSTANTIATE_TEST_SUITE_P(MapBytes, Pictures, ::testing::Values("a.exr", "a.png", "a.tif", "a.bmp", "a.jpg"),
                         [](const auto& p) { return std::string(p.param).substr(2); });

TEST(MapBytes, OtherBytesAreNoMap) {
    EXPECT_THAT(complaint([] {
                    readNumberMap(FileBytes{"a.exr", "GIF89a"});
                }),
                HasSubstr("begins like none"));
    EXPECT_THAT(complaint([] { readNumberMap(FileBytes{"a.exr", ""}); }), HasSubstr("begins like none"));
}

TEST(MapBytes, DamagedFilesAreRefusedOrRead) {
    const test::TemporaryFolder folder;
    std::mt19937 random(7);
    for (const char* name : {"a.exr", "a.png", "a.pfm"}) {
        const std::string path = folder.path(name);
        FileBytes whole{path, test::pfmBytes(ramp({16, 9}, 3))};
        if (std::string(name) != "a.pfm") {
            test::writeMap(path, ramp({16, 9}, 3));
            whole = readFile(path, "a picture");
        }
        for (int round = 0; round < 400; ++round) {
            FileBytes damaged = whole;
            if (round % 2 == 0) damaged.bytes.resize(random() % damaged.bytes.size());
            for (int i = 0; i < 4 && !damaged.bytes.empty(); ++i)
                damaged.bytes[random() % damaged.bytes.size()] = static_cast<char>(random());
            complaint([&] {
                const NumberMap map = readNumberMap(damaged);
                EXPECT_EQ(map.values.size(), static_cast<size_t>(map.sizePx.x) *
                                                 static_cast<size_t>(map.sizePx.y) *
                                                 static_cast<size_t>(map.channels));
            });
        }
    }
}

}  // namespace
}  // namespace curvewall
