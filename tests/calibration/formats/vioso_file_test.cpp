#include "calibration/formats/vioso_file.h"

#include "calibration/errors.h"
#include "calibration/formats/vioso_blocks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace curvewall {
namespace {

constexpr int kWidth = 3, kHeight = 2;

template <class Number>
void put(std::string& bytes, Number number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

std::string warpBlock(uint32_t flags = 0, float blackScale = 0) {
    std::string block = "vwf0";
    for (const uint32_t number : {380u, flags, 1u, static_cast<uint32_t>(kWidth * kHeight * 16)})
        put(block, number);
    put(block, int32_t{kWidth});
    put(block, int32_t{kHeight});
    for (int i = 0; i < 8 + 16; ++i) put(block, i == 8 + 9 ? blackScale : 0.0f);
    block.resize(380, '\0');
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            put(block, (static_cast<float>(x) + 0.5f) / kWidth);
            put(block, (static_cast<float>(y) + 0.5f) / kHeight);
            put(block, 1.0f);
            put(block, 0.0f);
        }
    return block;
}

// Pixel i, counted from the top left one, has the colour (i, i + 1, i + 2) / 10.
std::string bitmapBlock(int bits, bool topDown) {
    std::string rows;
    const int samples = bits % 24 == 0 && bits != 96 ? 3 : bits == 96 ? 3 : 4;
    for (int row = 0; row < kHeight; ++row) {
        const int y = topDown ? row : kHeight - 1 - row;
        const size_t begin = rows.size();
        for (int x = 0; x < kWidth; ++x)
            for (int s = 0; s < samples; ++s) {
                const double value = s == 3 ? 1 : (y * kWidth + x + 2 - s) / 10.0;  // blue first
                if (bits / samples == 8) put(rows, static_cast<uint8_t>(std::lround(255 * value)));
                if (bits / samples == 16) put(rows, static_cast<uint16_t>(std::lround(65535 * value)));
                if (bits / samples == 32) put(rows, static_cast<float>(value));
            }
        while ((rows.size() - begin) % 4 != 0) rows += '\0';
    }
    std::string block = "BM";
    put(block, static_cast<uint32_t>(54 + rows.size()));
    put(block, uint32_t{0});
    put(block, uint32_t{54});
    put(block, uint32_t{40});
    put(block, int32_t{kWidth});
    put(block, int32_t{topDown ? -kHeight : kHeight});
    put(block, uint16_t{1});
    put(block, static_cast<uint16_t>(bits));
    for (int i = 0; i < 6; ++i) put(block, uint32_t{0});
    return block + rows;
}

FileBytes fileOf(const std::vector<std::string>& blocks) {
    FileBytes file{"wall.vwf", "vwf1"};
    put(file.bytes, static_cast<uint32_t>(blocks.size()));
    put(file.bytes, uint32_t{16});
    put(file.bytes, uint32_t{0});
    for (const std::string& block : blocks) file.bytes += block;
    return file;
}

Display readOne(const FileBytes& file, const nlohmann::json& assume = nlohmann::json::object()) {
    Decisions decisions(assume);
    return readViosoFile(
               file, [](const std::string&) { return std::nullopt; }, {}, decisions)
        .displays.at(0);
}

class BlendBits : public ::testing::TestWithParam<std::tuple<int, bool>> {};

TEST_P(BlendBits, AreReadFromBlueGreenRedOfEitherRowOrder) {
    const auto [bits, topDown] = GetParam();
    const Display display =
        readOne(fileOf({warpBlock(), bitmapBlock(bits, topDown)}), {{"intensity_gamma", 1}});
    ASSERT_TRUE(display.blend);
    ASSERT_EQ(display.blend->alpha.size(), static_cast<size_t>(kWidth * kHeight));
    for (int i = 0; i < kWidth * kHeight; ++i)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(display.blend->alpha[static_cast<size_t>(i)][c], (i + c) / 10.0, 0.51 / 255)
                << i << " " << c;
    EXPECT_TRUE(display.blend->beta.empty());
}

INSTANTIATE_TEST_SUITE_P(Vioso, BlendBits,
                         ::testing::Combine(::testing::Values(24, 32, 48, 64, 96, 128), ::testing::Bool()));

TEST(Vioso, BlendsMultiplyEncodedColours) {
    const Display display = readOne(fileOf({warpBlock(), bitmapBlock(24, true)}));
    EXPECT_NEAR(display.blend->alpha[3].x, std::pow(0.3, 2.2), 0.01);
}

TEST(Vioso, BlackLevelsAreScaledByTheWarp) {
    constexpr uint32_t kLevels = 0x20;
    const Display display =
        readOne(fileOf({warpBlock(kLevels, 0.5f), bitmapBlock(24, true), bitmapBlock(96, false)}),
                {{"intensity_gamma", 1}});
    ASSERT_EQ(display.blend->beta.size(), static_cast<size_t>(kWidth * kHeight));
    EXPECT_NEAR(display.blend->beta[2].x, 0.1, 1e-6);
    EXPECT_NEAR(display.blend->beta[2].z, 0.2, 1e-6);
}

TEST(Vioso, BitmapsBelongToTheWarpBeforeThem) {
    Decisions decisions;
    const Wall wall = readViosoFile(
        fileOf({warpBlock(), warpBlock(), bitmapBlock(24, true)}),
        [](const std::string&) { return std::nullopt; }, {}, decisions);
    ASSERT_EQ(wall.displays.size(), 2u);
    EXPECT_NE(wall.displays[0].name, wall.displays[1].name);
    EXPECT_FALSE(wall.displays[0].blend);
    EXPECT_TRUE(wall.displays[1].blend);
}

TEST(Vioso, DamagedFilesAreRefusedOrRead) {
    const FileBytes whole =
        fileOf({warpBlock(0x20, 1), bitmapBlock(24, true), bitmapBlock(48, false), warpBlock()});
    const auto tryOut = [](const FileBytes& file) {
        try {
            Decisions decisions;
            readViosoFile(
                file, [](const std::string&) { return std::nullopt; }, {}, decisions);
        } catch (const InputError&) {
            return false;
        }
        return true;
    };
    EXPECT_TRUE(tryOut(whole));
    for (size_t size = 0; size < whole.bytes.size(); ++size)
        EXPECT_FALSE(tryOut({whole.path, whole.bytes.substr(0, size)})) << size;
    std::mt19937 random(19);
    for (int round = 0; round < 5000; ++round) {
        FileBytes damaged = whole;
        for (int i = 0; i < 3; ++i) damaged.bytes[random() % 140] = static_cast<char>(random());
        damaged.bytes[random() % damaged.bytes.size()] = static_cast<char>(random());
        tryOut(damaged);
    }
}

}  // namespace
}  // namespace curvewall
