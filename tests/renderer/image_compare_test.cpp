#include "renderer/image_compare.h"

#include "calibration/errors.h"
#include "renderer/image_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace curvewall {
namespace {

template <class ByteAt>
Frame frameOf(glm::ivec2 sizePx, ByteAt byteAt) {
    Frame frame{sizePx, 3, {}};
    for (int y = 0; y < sizePx.y; ++y)
        for (int x = 0; x < sizePx.x; ++x)
            for (int c = 0; c < 3; ++c)
                frame.texels.push_back(linearFromSrgbByte(static_cast<uint8_t>(byteAt(x, y, c))));
    return frame;
}

Frame noise(glm::ivec2 sizePx, uint32_t seed) {
    std::mt19937 random(seed);
    return frameOf(sizePx, [&](int, int, int) { return random() % 256; });
}

Frame grey(glm::ivec2 sizePx, int byte) {
    return frameOf(sizePx, [=](int, int, int) { return byte; });
}

TEST(CompareColor, EqualPicturesDoNotDiffer) {
    const ImageDifference d = compareColor(noise({33, 17}, 1), noise({33, 17}, 1));
    EXPECT_EQ(d.shareOff, 0);
    EXPECT_EQ(d.maxDifference, 0);
    EXPECT_TRUE(std::isinf(d.psnrDb));
    EXPECT_NEAR(d.ssim, 1, 1e-9);
}

TEST(CompareColor, CountsPixelsOffByMoreThanEight) {
    const Frame a = grey({10, 10}, 100);
    // Columns 0 and 1 are off by 8 in one channel, columns 2 to 4 by 9.
    const Frame b = frameOf({10, 10}, [](int x, int, int c) {
        if (c != 1 || x > 4) return 100;
        return x < 2 ? 108 : 91;
    });
    const ImageDifference d = compareColor(a, b);
    EXPECT_DOUBLE_EQ(d.shareOff, 0.3);
    EXPECT_EQ(d.maxDifference, 9);
    const double meanSquare = (20 * 64 + 30 * 81) / 300.0;
    EXPECT_NEAR(d.psnrDb, 10 * std::log10(255 * 255 / meanSquare), 1e-9);
}

TEST(CompareColor, LightIsComparedAsTheViewerGetsIt) {
    // A tenth of the light apart in a dark place: more than eight bytes. In a bright place: fewer.
    const auto plain = [](float light) { return Frame{{1, 1}, 3, {light, light, light}}; };
    EXPECT_GT(compareColor(plain(0.0f), plain(0.1f)).maxDifference, 80);
    EXPECT_LT(compareColor(plain(0.9f), plain(1.0f)).maxDifference, 15);
    EXPECT_EQ(compareColor(plain(1.0f), plain(5.0f)).maxDifference, 0);
}

// Without structure the formula is (2 a b + C1) / (a^2 + b^2 + C1).
TEST(CompareColor, SimilarityOfPlainPicturesIsThatOfTheirLuminance) {
    const double c1 = 6.5025;
    EXPECT_NEAR(compareColor(grey({20, 20}, 100), grey({20, 20}, 150)).ssim,
                (2 * 100 * 150 + c1) / (100 * 100 + 150 * 150 + c1), 1e-9);
    EXPECT_NEAR(compareColor(grey({3, 2}, 10), grey({3, 2}, 200)).ssim,
                (2 * 10 * 200 + c1) / (10 * 10 + 200 * 200 + c1), 1e-9);
}

TEST(CompareColor, InvertedStructureIsNegative) {
    const auto board = [](bool inverted) {
        return frameOf({16, 16},
                       [=](int x, int y, int) { return ((x + y) % 2 == 1) != inverted ? 200 : 50; });
    };
    EXPECT_LT(compareColor(board(false), board(true)).ssim, -0.9);
}

// The definition, window by window and in the two-pass form.
double ssimByDefinition(const Frame& a, const Frame& b) {
    const auto lumaAt = [](const Frame& f, int x, int y) {
        const float* t = f.at(x, y);
        return 0.2126 * srgbByteFromLinear(t[0]) + 0.7152 * srgbByteFromLinear(t[1]) +
               0.0722 * srgbByteFromLinear(t[2]);
    };
    double total = 0;
    int windows = 0;
    for (int y0 = 0; y0 + 8 <= a.sizePx.y; ++y0)
        for (int x0 = 0; x0 + 8 <= a.sizePx.x; ++x0, ++windows) {
            double meanA = 0, meanB = 0, varianceA = 0, varianceB = 0, covariance = 0;
            for (int y = y0; y < y0 + 8; ++y)
                for (int x = x0; x < x0 + 8; ++x)
                    meanA += lumaAt(a, x, y) / 64, meanB += lumaAt(b, x, y) / 64;
            for (int y = y0; y < y0 + 8; ++y)
                for (int x = x0; x < x0 + 8; ++x) {
                    const double da = lumaAt(a, x, y) - meanA, db = lumaAt(b, x, y) - meanB;
                    varianceA += da * da / 64, varianceB += db * db / 64, covariance += da * db / 64;
                }
            total += (2 * meanA * meanB + 6.5025) * (2 * covariance + 58.5225) /
                     ((meanA * meanA + meanB * meanB + 6.5025) * (varianceA + varianceB + 58.5225));
        }
    return total / windows;
}

TEST(CompareColor, SimilarityFollowsTheDefinition) {
    const Frame a = noise({21, 13}, 2), b = noise({21, 13}, 3);
    EXPECT_NEAR(compareColor(a, b).ssim, ssimByDefinition(a, b), 1e-9);
    const Frame ramp = frameOf({40, 9}, [](int x, int y, int c) { return 5 * x + y + c; });
    const Frame brighter = frameOf({40, 9}, [](int x, int y, int c) { return 5 * x + 2 * y + c + 9; });
    EXPECT_NEAR(compareColor(ramp, brighter).ssim, ssimByDefinition(ramp, brighter), 1e-9);
}

TEST(CompareColor, OnlyColourPicturesOfOneSizeCompare) {
    EXPECT_THROW(compareColor(grey({4, 4}, 0), grey({4, 5}, 0)), UsageError);
    EXPECT_THROW(compareColor(Frame{{1, 1}, 1, {0}}, Frame{{1, 1}, 1, {0}}), UsageError);
    EXPECT_THROW(compareColor(Frame{}, Frame{}), UsageError);
}

}  // namespace
}  // namespace curvewall
