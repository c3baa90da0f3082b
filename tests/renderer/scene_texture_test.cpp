#include "calibration/errors.h"
#include "renderer/scene/texture.h"
#include "tests/renderer/scene_checks.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <numeric>

namespace curvewall {
namespace {

using testing::HasSubstr;

std::vector<uint8_t> encoded(const test::TemporaryFolder& folder, const std::string& name, glm::ivec2 sizePx,
                             int channels, const std::vector<uint8_t>& data) {
    const std::string path = folder.pathOf(name);
    const auto output = OIIO::ImageOutput::create(path);
    OIIO::ImageSpec spec(sizePx.x, sizePx.y, channels, OIIO::TypeDesc::UINT8);
    spec["oiio:UnassociatedAlpha"] = 1;
    if (!output->open(path, spec) || !output->write_image(OIIO::TypeDesc::UINT8, data.data()) ||
        !output->close())
        throw std::runtime_error(output->geterror());
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

TEST(MipChain, AveragesInLinearLight) {
    // Half of the light of white is 188 in sRGB: 255 (1.055 * 0.5^(1/2.4) - 0.055) = 187.5.
    const glm::u8vec4 black(0, 0, 0, 0), white(255);
    const Texture board = makeTexture("board", {2, 2}, {black, white, white, black});
    ASSERT_EQ(board.levels.size(), 2u);
    EXPECT_EQ(board.levels[1].texels[0], glm::u8vec4(188, 188, 188, 128)) << "alpha is linear";
}

TEST(MipChain, GoesDownToOneTexel) {
    const std::vector<glm::ivec2> sizes{{1, 1}, {1, 7}, {8, 8}, {5, 3}, {100, 37}, {64, 1}};
    for (const glm::ivec2 size : sizes) {
        const Texture texture = makeTexture(
            "t", size,
            std::vector<glm::u8vec4>(static_cast<size_t>(size.x * size.y), glm::u8vec4(93, 12, 201, 77)));
        EXPECT_EQ(texture.levels.front().sizePx, size);
        EXPECT_EQ(texture.levels.back().sizePx, glm::ivec2(1));
        for (size_t i = 0; i < texture.levels.size(); ++i) {
            const MipLevel& level = texture.levels[i];
            if (i > 0) {
                EXPECT_EQ(level.sizePx, glm::max(texture.levels[i - 1].sizePx / 2, glm::ivec2(1)));
            }
            ASSERT_EQ(level.texels.size(), static_cast<size_t>(level.sizePx.x * level.sizePx.y));
            for (const glm::u8vec4& t : level.texels)
                EXPECT_EQ(t, glm::u8vec4(93, 12, 201, 77)) << "a flat colour stays";
        }
    }
}

TEST(MipChain, CountsEveryTexelEquallyWhateverTheSize) {
    // Alpha is linear, so the last level is the plain mean, up to one rounding.
    for (const glm::ivec2 size :
         {glm::ivec2(3, 1), glm::ivec2(5, 5), glm::ivec2(7, 3), glm::ivec2(9, 6), glm::ivec2(31, 17)}) {
        for (int lit = 0; lit < size.x * size.y; lit += 3) {
            std::vector<glm::u8vec4> texels(static_cast<size_t>(size.x * size.y), glm::u8vec4(0, 0, 0, 100));
            texels[static_cast<size_t>(lit)].a = 255;
            const Texture texture = makeTexture("t", size, texels);
            EXPECT_NEAR(texture.levels.back().texels[0].a, 100 + 155.0 / (size.x * size.y), 0.51)
                << size.x << " x " << size.y << " at " << lit;
        }
    }
}

TEST(DecodeImage, KeepsTheBytesOfAPng) {
    const test::TemporaryFolder folder;
    const auto rgba = encoded(folder, "a.png", {2, 1}, 4, {250, 120, 30, 0, 10, 20, 30, 128});
    const MipLevel image = decodeImage("a.gltf", "images[0]", rgba);
    EXPECT_EQ(image.sizePx, glm::ivec2(2, 1));
    EXPECT_EQ(image.texels[0], glm::u8vec4(250, 120, 30, 0)) << "colour is not multiplied by alpha";
    EXPECT_EQ(image.texels[1], glm::u8vec4(10, 20, 30, 128));

    const auto grey = encoded(folder, "g.png", {1, 2}, 1, {7, 200});
    EXPECT_EQ(decodeImage("a.gltf", "images[0]", grey).texels[1], glm::u8vec4(200, 200, 200, 255));
}

TEST(DecodeImage, ReadsJpeg) {
    const test::TemporaryFolder folder;
    const auto jpeg = encoded(folder, "a.jpg", {16, 16}, 3, std::vector<uint8_t>(16 * 16 * 3, 90));
    const MipLevel image = decodeImage("a.gltf", "images[0]", jpeg);
    EXPECT_EQ(image.sizePx, glm::ivec2(16));
    EXPECT_NEAR(image.texels[100].g, 90, 2);
}

TEST(DecodeImage, RefusesWhatItCannotRead) {
    const auto refuse = [](const std::string& bytes) {
        return test::messageOf<InputError>(
            [&] { decodeImage("a.gltf", "images[3]", std::vector<uint8_t>(bytes.begin(), bytes.end())); });
    };
    EXPECT_THAT(refuse("\xabKTX 20\xbb\r\n"),
                HasSubstr("a.gltf: images[3]: expected a PNG or JPEG image, found a KTX image"));
    EXPECT_THAT(refuse(std::string("RIFF\0\0\0\0WEBPVP8 ", 16)), HasSubstr("a WebP image"));
    EXPECT_THAT(refuse(""), HasSubstr("unknown bytes"));
    EXPECT_THAT(refuse("\x89PNG\r\n\x1a\n"), HasSubstr("a readable image"));
    EXPECT_THAT(refuse("\xff\xd8\xff\xe0junk"), HasSubstr("a readable image"));
}

TEST(DecodeImage, SurvivesATruncatedPng) {
    const test::TemporaryFolder folder;
    std::vector<uint8_t> noise(64 * 64 * 3);
    for (size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<uint8_t>(i * i * 31 >> 3);
    const auto png = encoded(folder, "a.png", {64, 64}, 3, noise);
    for (size_t length = 0; length < png.size(); length += 1009) {
        try {
            decodeImage("a.gltf", "images[0]", std::span(png).first(length));
        } catch (const InputError&) {
        }
    }
}

TEST(DecodeImage, RefusesMoreThan8192PixelsASide) {
    const test::TemporaryFolder folder;
    const auto wide = encoded(folder, "a.png", {8193, 1}, 1, std::vector<uint8_t>(8193));
    EXPECT_THAT(test::messageOf<InputError>([&] { decodeImage("a.gltf", "images[0]", wide); }),
                HasSubstr("8193 x 1"));
}

}  // namespace
}  // namespace curvewall
