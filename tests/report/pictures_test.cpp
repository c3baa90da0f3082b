#include "report/pictures.h"

#include "calibration/errors.h"
#include "renderer/image_file.h"
#include "tests/support/random_numbers.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace curvewall {
namespace {

constexpr glm::ivec2 kSizePx{60, 40};
constexpr double kTolerancePx = 0.25;

Frame constantFrame(glm::ivec2 sizePx, float value) {
    return {sizePx, 3, std::vector<float>(static_cast<size_t>(sizePx.x * sizePx.y * 3), value)};
}

float& texel(Frame& frame, int x, int y, int channel) {
    return frame.texels[static_cast<size_t>((y * frame.sizePx.x + x) * frame.channels + channel)];
}

double luminance(const Frame& frame, int x, int y) {
    const float* color = frame.at(x, y);
    return 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
}

std::array<int, 3> bytes(const Frame& frame, int x, int y) {
    const float* color = frame.at(x, y);
    return {srgbByteFromLinear(color[0]), srgbByteFromLinear(color[1]), srgbByteFromLinear(color[2])};
}

TEST(ErrorMap, IsBrighterWhereTheErrorIsLarger) {
    std::vector<float> errorsPx(static_cast<size_t>(kSizePx.x * kSizePx.y), 0);
    for (int x = 0; x < kSizePx.x; ++x)
        errorsPx[static_cast<size_t>(x)] = 0.0157f * std::exp2(8 * static_cast<float>(x) / 60);
    const Frame map = errorMap(errorsPx, kSizePx, kTolerancePx);
    for (int x = 1; x < kSizePx.x; ++x) EXPECT_GT(luminance(map, x, 0), luminance(map, x - 1, 0)) << x;
}

TEST(ErrorMap, OfTwiceTheErrorsAtTwiceTheToleranceIsTheSame) {
    std::vector<float> once, twice;
    test::Random random(5);
    for (int i = 0; i < kSizePx.x * kSizePx.y; ++i) {
        once.push_back(static_cast<float>(random.uniform(0, 1)));
        twice.push_back(2 * once.back());
    }
    const Frame a = errorMap(once, kSizePx, kTolerancePx), b = errorMap(twice, kSizePx, 2 * kTolerancePx);
    for (int y = 0; y < kSizePx.y; ++y)
        for (int x = 0; x < kSizePx.x; ++x) EXPECT_EQ(bytes(a, x, y), bytes(b, x, y));
}

TEST(ErrorMap, IsGreyWhereNothingIsShown) {
    std::vector<float> errorsPx(static_cast<size_t>(kSizePx.x * kSizePx.y), 0.25f);
    errorsPx[3] = std::nanf("");
    errorsPx[5] = std::numeric_limits<float>::infinity();
    const Frame map = errorMap(errorsPx, kSizePx, kTolerancePx);
    const std::array<int, 3> grey{128, 128, 128};
    EXPECT_EQ(bytes(map, 3, 0), grey);
    EXPECT_EQ(bytes(map, 5, 0), grey);
    EXPECT_NE(bytes(map, 4, 0), grey);
}

TEST(ErrorMap, HasAScaleBelowWhoseMiddleIsTheTolerance) {
    const std::vector<float> errorsPx(static_cast<size_t>(kSizePx.x * kSizePx.y), kTolerancePx);
    const Frame map = errorMap(errorsPx, kSizePx, kTolerancePx);
    ASSERT_GT(map.sizePx.y, kSizePx.y + 10);
    EXPECT_EQ(map.sizePx.x, kSizePx.x);
    const int bar = kSizePx.y + 6;
    EXPECT_LT(luminance(map, 0, bar), luminance(map, 30, bar));
    EXPECT_LT(luminance(map, 30, bar), luminance(map, 59, bar));
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(bytes(map, 30, bar)[static_cast<size_t>(channel)],
                    bytes(map, 0, 0)[static_cast<size_t>(channel)], 8);
}

TEST(ErrorMap, ThatIsSmallerShowsTheWorstOfEachBlock) {
    const glm::ivec2 largePx{300, 100};
    std::vector<float> errorsPx(300 * 100, 0.01f);
    errorsPx[50 * 300 + 151] = 3;
    const Frame map = errorMap(errorsPx, largePx, kTolerancePx, 100);
    EXPECT_EQ(map.sizePx.x, 100);
    int bright = 0;
    for (int y = 0; y < 33; ++y)
        for (int x = 0; x < 100; ++x) bright += luminance(map, x, y) > 0.3;
    EXPECT_EQ(bright, 1);
    EXPECT_GT(luminance(map, 50, 16), 0.3);
}

TEST(Reduced, HasTheMeanLight) {
    Frame frame = constantFrame({6, 2}, 0);
    texel(frame, 0, 0, 1) = 1;
    texel(frame, 5, 1, 2) = 0.5f;
    const Frame small = reduced(frame, 3);
    ASSERT_EQ(small.sizePx, glm::ivec2(3, 1));
    EXPECT_EQ(small.texels, (std::vector<float>{0, 0.25f, 0, 0, 0, 0, 0, 0, 0.125f}));
    EXPECT_EQ(reduced(frame, 6).texels, frame.texels);
}

TEST(Enlarged, RepeatsPixels) {
    Frame frame = constantFrame(kSizePx, 0);
    for (size_t i = 0; i < frame.texels.size(); ++i) frame.texels[i] = static_cast<float>(i);
    const Frame large = enlarged(frame, {{10, 20}, 8}, 3);
    ASSERT_EQ(large.sizePx, glm::ivec2(24, 24));
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) EXPECT_EQ(*large.at(x, y), *frame.at(10 + x / 3, 20 + y / 3));
}

TEST(Enlarged, SquaresBeyondTheBorderAreMovedAndCut) {
    Frame frame = constantFrame({6, 4}, 0);
    texel(frame, 5, 3, 0) = 1;
    EXPECT_EQ(*enlarged(frame, {{100, 100}, 2}, 2).at(3, 3), 1);
    EXPECT_EQ(enlarged(frame, {{-3, 0}, 100}, 2).sizePx, glm::ivec2(12, 8));
}

TEST(WorstSquare, IsThatOfTheLargestSum) {
    test::Random random(8);
    for (int round = 0; round < 50; ++round) {
        std::vector<double> sum(static_cast<size_t>(kSizePx.x * kSizePx.y));
        for (double& value : sum) value = std::floor(random.uniform(0, 256));
        const auto inside = [&](glm::ivec2 corner) {
            double total = 0;
            for (int y = corner.y; y < corner.y + 16; ++y)
                for (int x = corner.x; x < corner.x + 16; ++x)
                    total += sum[static_cast<size_t>(y * kSizePx.x + x)];
            return total;
        };
        const Square worst = worstSquare(sum, kSizePx, 16);
        EXPECT_EQ(worst.sidePx, 16);
        for (int y = 0; y + 16 <= kSizePx.y; ++y)
            for (int x = 0; x + 16 <= kSizePx.x; ++x) EXPECT_LE(inside({x, y}), inside(worst.cornerPx));
    }
}

TEST(WorstSquare, OfEqualOnesIsTheFirst) {
    EXPECT_EQ(worstSquare(std::vector<double>(600, 1), {30, 20}, 7).cornerPx, glm::ivec2(0, 0));
    EXPECT_EQ(worstSquare(std::vector<double>(600, 1), {30, 20}, 64).sidePx, 20);
}

TEST(AddDifference, IsOfTheWorstChannelInBytes) {
    const Frame truth = constantFrame({2, 1}, linearFromSrgbByte(100));
    Frame drawn = truth;
    texel(drawn, 1, 0, 0) = linearFromSrgbByte(90);
    texel(drawn, 1, 0, 2) = linearFromSrgbByte(130);
    std::vector<double> sum;
    addDifference(sum, drawn, truth);
    addDifference(sum, drawn, truth);
    EXPECT_EQ(sum, (std::vector<double>{0, 60}));
}

}  // namespace
}  // namespace curvewall
