#include "calibration/files/map_file.h"

#include "calibration/errors.h"
#include "tests/support/map_writer.h"
#include "tests/support/random_numbers.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace curvewall {
namespace {

using ::testing::HasSubstr;

NumberMap randomMap(glm::ivec2 size, int channels, uint64_t seed) {
    test::Random random(seed);
    NumberMap map{size, channels, false, {}};
    for (int i = 0; i < size.x * size.y * channels; ++i)
        map.values.push_back(static_cast<float>(random.uniform(-100, 100)));
    return map;
}

template <typename Read>
std::string complaint(const Read& read) {
    try {
        read();
    } catch (const InputError& error) {
        return error.what();
    }
    return "nothing";
}

class MapFile : public ::testing::Test {
protected:
    std::string complaintAbout(const std::string& name, const std::string& bytes) const {
        return complaint([&] { readNumberMap(folder_.write(name, bytes)); });
    }
    test::TemporaryFolder folder_;
};

TEST_F(MapFile, PfmOfBothByteOrdersAndChannelCountsComesTopRowFirst) {
    for (const int channels : {1, 3})
        for (const bool bigEndian : {false, true}) {
            NumberMap map = randomMap({5, 3}, channels, 1);
            map.values[2] = std::numeric_limits<float>::infinity();
            const NumberMap read = readNumberMap(folder_.write("m.pfm", test::pfmBytes(map, bigEndian)));
            EXPECT_EQ(read.sizePx, map.sizePx);
            EXPECT_EQ(read.channels, channels);
            EXPECT_FALSE(read.isInteger);
            EXPECT_EQ(read.values, map.values);
        }
}

TEST_F(MapFile, PfmIsKnownByItsBytesAndTakesAnyWhiteSpace) {
    const std::string numbers(8, '\0');
    for (const char* header :
         {"Pf\n2 1\n-1\n", "Pf 2\t1 -1.000 ", "Pf\r\n2\r\n1\r\n-1\n", "Pf\n 2  1\n\n-1e0\n"})
        EXPECT_EQ(readNumberMap(folder_.write("m.dat", header + numbers)).sizePx, glm::ivec2(2, 1)) << header;
}

TEST_F(MapFile, DamagedPfmIsRefusedWithAReason) {
    const std::string numbers(8, '\0');
    EXPECT_THAT(complaintAbout("m.pfm", "Pf\n2 1\n-1\n" + numbers + "x"),
                HasSubstr("m.pfm: expected 8 bytes of numbers after the PFM header, found 9"));
    EXPECT_THAT(complaintAbout("m.pfm", "Pf\n2 1\n-1\n" + numbers.substr(1)), HasSubstr("found 7"));
    EXPECT_THAT(complaintAbout("m.pfm", "PF\n2 1\n-1\n" + numbers), HasSubstr("expected 24 bytes"));
    EXPECT_THAT(complaintAbout("m.pfm", "Pf\n2 1\n-1"), HasSubstr("header"));
    EXPECT_THAT(complaintAbout("m.pfm", "Pf\n2 1\n0\n" + numbers), HasSubstr("scale other than 0"));
    EXPECT_THAT(complaintAbout("m.pfm", "Pf\n2 1\nnan\n" + numbers), HasSubstr("scale other than 0"));
    EXPECT_THAT(complaintAbout("m.pfm", "Pf\n2 0\n-1\n"), HasSubstr("width and height"));
    EXPECT_THAT(complaintAbout("m.pfm", "Pf\n-2 -1\n-1\n" + numbers), HasSubstr("width and height"));
    EXPECT_THAT(complaintAbout("m.pfm", "Pf\n2x 1\n-1\n" + numbers), HasSubstr("width and height"));
    EXPECT_THAT(complaintAbout("m.pfm", "Pf\n2000000000 2000000000\n-1\n"),
                HasSubstr("at most 268435456 pixels"));
    EXPECT_THAT(complaintAbout("m.pfm", "Pf\n" + std::string(100'000, '1')), HasSubstr("width and height"));
    EXPECT_THAT(complaintAbout("m.pfm", "Pf\n"), HasSubstr("width and height"));
}

TEST_F(MapFile, AFileTooSmallForWhatItsHeaderSaysIsRefused) {
    // 100 bytes are enough for 8192 times as many, however well they are packed, and not for more.
    EXPECT_NO_THROW(requirePlausibleSize("small.png", 100, NumberMap{{204, 1000}, 1, false, {}}));
    EXPECT_THROW(requirePlausibleSize("small.png", 100, NumberMap{{205, 1000}, 1, false, {}}), InputError);
    EXPECT_THROW(requirePlausibleSize("small.png", 100, NumberMap{{16384, 16384}, 4, false, {}}), InputError);
}

TEST_F(MapFile, ExrComesBitByBit) {
    for (const char* compression : {"none", "zip", "zips", "rle", "piz"})
        for (const int channels : {1, 2, 3, 4}) {
            NumberMap map = randomMap({67, 41}, channels, 2);
            map.values[5] = std::numeric_limits<float>::infinity();
            test::writeMap(folder_.path("m.exr"), map, OIIO::TypeDesc::FLOAT, compression);
            const NumberMap read = readNumberMap(folder_.path("m.exr"));
            EXPECT_EQ(read.sizePx, map.sizePx);
            EXPECT_EQ(read.channels, channels);
            EXPECT_FALSE(read.isInteger);
            EXPECT_EQ(read.values, map.values) << compression << ", " << channels << " channels";
        }
}

// What OpenImageIO makes of the same file.
std::vector<float> openImageIoReads(const std::string& path, size_t numbers) {
    std::vector<float> values(numbers);
    const auto in = OIIO::ImageInput::open(path);
    if (!in || !in->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, values.data())) return {};
    return values;
}

TEST_F(MapFile, ExrOfEveryCompressionReadsAsInOpenImageIoOrIsForPictures) {
    const NumberMap map = randomMap({71, 150}, 3, 6);
    const std::string path = folder_.path("m.exr");
    for (const auto type : {OIIO::TypeDesc::FLOAT, OIIO::TypeDesc::HALF}) {
        for (const char* compression : {"none", "rle", "zips", "zip", "piz", "pxr24"}) {
            test::writeMap(path, map, type, compression);
            EXPECT_EQ(readNumberMap(path).values, openImageIoReads(path, map.values.size())) << compression;
        }
        for (const char* compression : {"b44", "b44a", "dwaa", "dwab"}) {
            test::writeMap(path, map, type, compression);
            EXPECT_THAT(complaint([&] { readNumberMap(path); }), HasSubstr("keeps its numbers"));
        }
    }
}

TEST_F(MapFile, TiledExrComesBitByBit) {
    for (const glm::ivec2 tilePx : {glm::ivec2(32), {16, 64}, {67, 41}, {128, 128}})
        for (const char* compression : {"none", "zip", "piz"}) {
            const std::string path = folder_.path("m.exr");
            const NumberMap map = randomMap({67, 41}, 3, 7);
            OIIO::ImageSpec spec(67, 41, 3, OIIO::TypeDesc::FLOAT);
            spec.tile_width = tilePx.x;
            spec.tile_height = tilePx.y;
            spec.attribute("compression", compression);
            const auto out = OIIO::ImageOutput::create(path);
            ASSERT_TRUE(out && out->open(path, spec) &&
                        out->write_image(OIIO::TypeDesc::FLOAT, map.values.data()) && out->close());
            EXPECT_EQ(readNumberMap(path).values, map.values) << tilePx.x << " " << compression;
            EXPECT_EQ(readNumberMap(readFile(path, "a map")).values, map.values);
        }
}

TEST_F(MapFile, ExrChannelsComeInTheOrderOfPictures) {
    struct Case {
        std::vector<std::string> written, read;
    };
    const std::string path = folder_.path("m.exr");
    for (const auto& [written, read] : std::vector<Case>{{{"A", "B", "G", "R"}, {"R", "G", "B", "A"}},
                                                         {{"B", "G", "R", "Z"}, {"R", "G", "B", "Z"}},
                                                         {{"X", "Y", "Z"}, {"X", "Y", "Z"}},
                                                         {{"A", "Y"}, {"Y", "A"}},
                                                         {{"U", "V"}, {"U", "V"}}}) {
        const int channels = static_cast<int>(written.size());
        OIIO::ImageSpec spec(1, 1, channels, OIIO::TypeDesc::FLOAT);
        spec.channelnames = written;
        // The number of a channel is the letter that is its name.
        std::vector<float> letters, expected;
        for (const std::string& name : written) letters.push_back(static_cast<float>(name[0]));
        for (const std::string& name : read) expected.push_back(static_cast<float>(name[0]));
        const auto out = OIIO::ImageOutput::create(path);
        ASSERT_TRUE(out && out->open(path, spec) && out->write_image(OIIO::TypeDesc::FLOAT, letters.data()) &&
                    out->close());
        EXPECT_EQ(readNumberMap(path).values, expected) << written[0];
    }
}

TEST_F(MapFile, HalfExrIsFloat) {
    NumberMap map = randomMap({20, 30}, 2, 3);
    for (float& value : map.values) value = std::round(value);
    test::writeMap(folder_.path("m.exr"), map, OIIO::TypeDesc::HALF);
    EXPECT_EQ(readNumberMap(folder_.path("m.exr")).values, map.values);
}

TEST_F(MapFile, DamagedExrIsRefused) {
    test::writeMap(folder_.path("m.exr"), randomMap({300, 200}, 2, 4));
    const std::string bytes = [this] {
        std::ifstream in(folder_.path("m.exr"), std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    }();
    for (const size_t size : {bytes.size() - 1, bytes.size() / 2, size_t{400}, size_t{100}, size_t{5}})
        EXPECT_THAT(complaintAbout("m.exr", bytes.substr(0, size)), HasSubstr("m.exr: expected"));
    // Whatever the bytes: an error or numbers, never a crash.
    test::Random random(5);
    for (int i = 0; i < 400; ++i) {
        std::string damaged = bytes;
        const double reach = i % 2 ? 600.0 : static_cast<double>(bytes.size());
        for (int k = 0; k < 3; ++k)
            damaged[static_cast<size_t>(random.uniform(0, reach))] =
                static_cast<char>(static_cast<int>(random.uniform(0, 256)));
        complaintAbout("m.exr", damaged);
    }
}

TEST_F(MapFile, AnExrAttributeLongerThanTheFileTakesNoMemory) {
    using namespace std::string_literals;
    for (const std::string type : {"opaque", "string", "stringvector", "preview", "chlist"}) {
        const std::string bytes = "\x76\x2f\x31\x01\2\0\0\0"s + "a\0"s + type + "\0"s + "\0\0\0\x60"s + "few";
        EXPECT_THAT(complaintAbout("m.exr", bytes), HasSubstr("m.exr: expected a sound EXR"));
        EXPECT_THAT(complaint([&] {
                        readNumberMap(FileBytes{"in memory.exr", bytes});
                    }),
                    HasSubstr("in memory.exr: expected a sound EXR"));
    }
}

TEST_F(MapFile, IntegersComeAsFractions) {
    NumberMap map{{2, 1}, 3, false, {0, 0.25f, 1, 0.5f, 0.75f, 0.1f}};
    for (const auto type : {OIIO::TypeDesc::UINT16, OIIO::TypeDesc::UINT8}) {
        test::writeMap(folder_.path("m.png"), map, type);
        const NumberMap read = readNumberMap(folder_.path("m.png"));
        EXPECT_TRUE(read.isInteger);
        ASSERT_EQ(read.values.size(), 6u);
        for (size_t i = 0; i < 6; ++i)
            EXPECT_NEAR(read.values[i], map.values[i], type == OIIO::TypeDesc::UINT8 ? 2e-3 : 1e-5);
    }
}

TEST_F(MapFile, WhatIsNoPictureIsRefused) {
    EXPECT_THAT(complaintAbout("m.exr", "no picture"), HasSubstr("m.exr: expected a readable image"));
    EXPECT_THROW(readNumberMap(folder_.path("absent.pfm")), InputError);
    EXPECT_THROW(readNumberMap(folder_.path()), InputError);
}

}  // namespace
}  // namespace curvewall
