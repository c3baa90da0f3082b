#include "renderer/image_file.h"

#include "calibration/errors.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <regex>

namespace curvewall {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;
namespace fs = std::filesystem;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

class ImageFile : public testing::Test {
protected:
    ImageFile()
        : folder_(fs::path(testing::TempDir()) / (std::string("curvewall_image_file_") + testName())) {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~ImageFile() override { fs::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }

private:
    static const char* testName() { return testing::UnitTest::GetInstance()->current_test_info()->name(); }

    fs::path folder_;
};

std::vector<uint8_t> bytesOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void writeBytes(const std::string& path, const std::vector<uint8_t>& bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

// 16 x 16 with every byte value in every channel, in other places.
Frame allBytes() {
    Frame frame{{16, 16}, 3, {}};
    for (int i = 0; i < 256; ++i)
        for (const int byte : {i, 255 - i, (7 * i) % 256})
            frame.texels.push_back(linearFromSrgbByte(static_cast<uint8_t>(byte)));
    return frame;
}

// IEC 61966-2-1, the encoding direction.
double srgbFromLinear(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

TEST(Srgb, KnownValues) {
    EXPECT_EQ(srgbByteFromLinear(0.0f), 0);
    EXPECT_EQ(srgbByteFromLinear(0.5f), 188);
    EXPECT_EQ(srgbByteFromLinear(0.2158605f), 128);
    EXPECT_EQ(srgbByteFromLinear(1.0f), 255);
    EXPECT_FLOAT_EQ(linearFromSrgbByte(128), 0.2158605f);
    EXPECT_FLOAT_EQ(linearFromSrgbByte(10), 10 / 255.0f / 12.92f);
}

TEST(Srgb, BytesSurvive) {
    for (int byte = 0; byte < 256; ++byte)
        EXPECT_EQ(srgbByteFromLinear(linearFromSrgbByte(static_cast<uint8_t>(byte))), byte);
}

TEST(Srgb, RoundsToTheNearestByte) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int i = 0; i < 100000; ++i) {
        const float linear = std::pow(unit(random), 3.0f);
        EXPECT_NEAR(srgbByteFromLinear(linear), 255 * srgbFromLinear(linear), 0.5 + 1e-6) << linear;
    }
}

TEST(Srgb, WhatIsNoLightIsClamped) {
    EXPECT_EQ(srgbByteFromLinear(-1), 0);
    EXPECT_EQ(srgbByteFromLinear(1e30f), 255);
    EXPECT_EQ(srgbByteFromLinear(kInfinity), 255);
    EXPECT_EQ(srgbByteFromLinear(-kInfinity), 0);
    EXPECT_EQ(srgbByteFromLinear(kNaN), 0);
}

TEST(ImageFormatFromPath, ComesFromTheExtension) {
    EXPECT_EQ(imageFormatFromPath("a.png"), ImageFormat::png);
    EXPECT_EQ(imageFormatFromPath("a.b/c.JPG"), ImageFormat::jpeg);
    EXPECT_EQ(imageFormatFromPath("a.jpeg"), ImageFormat::jpeg);
    EXPECT_EQ(imageFormatFromPath(".exr"), ImageFormat::exr);
    for (const char* path : {"", "a", "png", "a.tiff", "a.png/b", "a.png.", "a.pn"})
        EXPECT_THROW(imageFormatFromPath(path), UsageError) << path;
}

TEST_F(ImageFile, PngKeepsEveryByte) {
    const Frame frame = allBytes();
    writeFrame(path("a.png"), frame);
    const Frame back = readFrame(path("a.png"));
    EXPECT_EQ(back.sizePx, frame.sizePx);
    EXPECT_EQ(back.channels, 3);
    EXPECT_THAT(back.texels, testing::Pointwise(testing::FloatEq(), frame.texels));
}

TEST_F(ImageFile, TheFirstRowIsTheTop) {
    Frame frame{{1, 2}, 3, {1, 0, 0, 0, 0, 1}};
    for (const char* name : {"a.png", "a.exr"}) {
        writeFrame(path(name), frame);
        EXPECT_EQ(readFrame(path(name)).texels, frame.texels) << name;
    }
}

// At quality 95 without subsampling, a smooth picture is off by little even at single texels.
TEST_F(ImageFile, JpegIsCloseOnSmoothPictures) {
    Frame frame{{64, 64}, 3, {}};
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (const int byte : {3 * x + 20, 3 * y + 20, 255 - 2 * x})
                frame.texels.push_back(linearFromSrgbByte(static_cast<uint8_t>(byte)));
    writeFrame(path("a.jpg"), frame);
    const Frame back = readFrame(path("a.jpg"));
    ASSERT_EQ(back.texels.size(), frame.texels.size());
    for (size_t i = 0; i < frame.texels.size(); ++i)
        EXPECT_NEAR(srgbByteFromLinear(back.texels[i]), srgbByteFromLinear(frame.texels[i]), 6);
}

TEST_F(ImageFile, ExrKeepsEveryFloat) {
    const Frame color{{2, 2}, 3, {0.1f, 1e-30f, 3e38f, -1, 0, 1, 100.25f, kInfinity, -kInfinity, 5, 6, 7}};
    writeFrame(path("color.exr"), color);
    EXPECT_EQ(readFrame(path("color.exr")).texels, color.texels);

    const Frame depth{{3, 1}, 1, {1234.56789f, kInfinity, 0.1f}};
    writeFrame(path("depth.exr"), depth, OutputKind::depth);
    EXPECT_EQ(readFrame(path("depth.exr")).channels, 1);
    EXPECT_EQ(readFrame(path("depth.exr")).texels, depth.texels);

    const Frame position{{2, 1}, 3, {1, 2, 3, kNaN, kNaN, kNaN}};
    writeFrame(path("position.exr"), position, OutputKind::position);
    const Frame back = readFrame(path("position.exr"));
    EXPECT_EQ(std::vector<float>(back.texels.begin(), back.texels.begin() + 3),
              (std::vector<float>{1, 2, 3}));
    for (size_t i = 3; i < 6; ++i) EXPECT_TRUE(std::isnan(back.texels[i]));
}

// A channel in an OpenEXR header is its name, a zero and its type; 2 is 32-bit float.
TEST_F(ImageFile, ExrNamesItsChannels) {
    const auto has = [](const std::vector<uint8_t>& file, const std::string& channel) {
        const std::string entry = channel + std::string("\0\2\0\0\0", 5);
        return std::search(file.begin(), file.end(), entry.begin(), entry.end()) != file.end();
    };
    const Frame one{{1, 1}, 1, {1}}, three{{1, 1}, 3, {1, 2, 3}};
    const auto color = encodeFrame(three, ImageFormat::exr);
    EXPECT_TRUE(has(color, "R") && has(color, "G") && has(color, "B"));
    const auto position = encodeFrame(three, ImageFormat::exr, OutputKind::position);
    EXPECT_TRUE(has(position, "X") && has(position, "Y") && has(position, "Z"));
    EXPECT_TRUE(has(encodeFrame(one, ImageFormat::exr, OutputKind::depth), "Z"));
    EXPECT_TRUE(has(encodeFrame(one, ImageFormat::exr, OutputKind::coverage), "coverage"));
}

TEST_F(ImageFile, FileAndMemoryHoldTheSameBytes) {
    const Frame frame = allBytes();
    for (const auto& [name, format] :
         {std::pair{"a.png", ImageFormat::png}, {"a.jpg", ImageFormat::jpeg}, {"a.exr", ImageFormat::exr}}) {
        writeFrame(path(name), frame);
        EXPECT_EQ(bytesOf(path(name)), encodeFrame(frame, format)) << name;
        EXPECT_EQ(encodeFrame(frame, format), encodeFrame(frame, format)) << name;
    }
}

// Or the same picture would be another file tomorrow, or with the next version of a library.
TEST_F(ImageFile, NoDateAndNoSoftwareIsWritten) {
    for (const ImageFormat format : {ImageFormat::png, ImageFormat::jpeg, ImageFormat::exr}) {
        const auto file = encodeFrame(allBytes(), format);
        const std::string text(file.begin(), file.end());
        EXPECT_FALSE(std::regex_search(text, std::regex("[0-9]{4}[:-][0-9]{2}[:-][0-9]{2}")));
        for (const char* word : {"OpenImageIO", "Software", "software", "tIME", "tEXt"})
            EXPECT_EQ(text.find(word), std::string::npos) << word;
    }
}

TEST_F(ImageFile, EightBitFilesTakeColourOnly) {
    const Frame one{{1, 1}, 1, {1}}, three{{1, 1}, 3, {1, 2, 3}};
    const auto expectRefusal = [](auto encode) {
        EXPECT_THAT(encode, ThrowsMessage<UsageError>(HasSubstr("need .exr")));
    };
    for (const ImageFormat format : {ImageFormat::png, ImageFormat::jpeg}) {
        expectRefusal([&] { encodeFrame(one, format, OutputKind::depth); });
        expectRefusal([&] { encodeFrame(one, format, OutputKind::coverage); });
        expectRefusal([&] { encodeFrame(one, format); });
        expectRefusal([&] { encodeFrame(three, format, OutputKind::position); });
    }
    expectRefusal([&] { writeFrame(path("a.png"), three, OutputKind::position); });
    EXPECT_FALSE(fs::exists(path("a.png")));
}

TEST_F(ImageFile, UnwritablePlacesAreNamed) {
    const std::string nowhere = path("no/such/folder/a.png");
    EXPECT_THAT([&] { writeFrame(nowhere, allBytes()); },
                ThrowsMessage<std::runtime_error>(AllOf(HasSubstr(nowhere), HasSubstr("No such file"))));
    // One picture that is written at once, and one so small that it waits for the file to be closed.
    fs::create_symlink("/dev/full", path("full.exr"));
    for (const Frame& frame : {allBytes(), Frame{{1, 1}, 3, {1, 1, 1}}})
        EXPECT_THAT([&] { writeFrame(path("full.exr"), frame); },
                    ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("full.exr"), HasSubstr("No space"))));
    EXPECT_THROW(encodeFrame(Frame{{0, 0}, 3, {}}, ImageFormat::png), std::runtime_error);
}

TEST_F(ImageFile, UnreadableFilesAreNamed) {
    const std::string missing = path("missing.png");
    EXPECT_THAT([&] { readFrame(missing); }, ThrowsMessage<InputError>(HasSubstr(missing)));
    writeBytes(path("text.png"), {'h', 'e', 'l', 'l', 'o'});
    EXPECT_THAT(
        [&] { readFrame(path("text.png")); },
        ThrowsMessage<InputError>(AllOf(HasSubstr("text.png"), HasSubstr("expected a readable image"))));
    writeBytes(path("empty.exr"), {});
    EXPECT_THROW(readFrame(path("empty.exr")), InputError);
}

TEST_F(ImageFile, DamagedFilesAreReadOrRefused) {
    std::mt19937 random(1);
    for (const auto& [name, format] :
         {std::pair{"a.png", ImageFormat::png}, {"a.jpg", ImageFormat::jpeg}, {"a.exr", ImageFormat::exr}}) {
        const auto file = encodeFrame(allBytes(), format);
        for (int i = 0; i < 300; ++i) {
            auto damaged = file;
            if (i % 3 == 0) damaged.resize(random() % file.size());
            for (size_t hits = random() % 4; hits > 0 && !damaged.empty(); --hits)
                damaged[random() % damaged.size()] = static_cast<uint8_t>(random());
            writeBytes(path(name), damaged);
            try {
                const Frame frame = readFrame(path(name));
                EXPECT_EQ(frame.texels.size(),
                          static_cast<size_t>(frame.sizePx.x * frame.sizePx.y * frame.channels));
            } catch (const InputError&) {
            }
        }
    }
}

}  // namespace
}  // namespace curvewall
