#include "report/words.h"

#include <gtest/gtest.h>

#include <limits>

namespace curvewall {
namespace {

TEST(Words, OfCountsHaveCommas) {
    EXPECT_EQ(countText(0), "0");
    EXPECT_EQ(countText(999), "999");
    EXPECT_EQ(countText(1673), "1,673");
    EXPECT_EQ(countText(1234567), "1,234,567");
}

TEST(Words, OfMeasuresHaveThreeDigits) {
    EXPECT_EQ(measureText(0), "0");
    EXPECT_EQ(measureText(0.24751), "0.248");
    EXPECT_EQ(measureText(0.25), "0.25");
    EXPECT_EQ(measureText(62.14), "62.1");
    EXPECT_EQ(measureText(100), "100");
    EXPECT_EQ(measureText(999.4), "999");
    EXPECT_EQ(measureText(1240.4), "1,240");
    EXPECT_EQ(measureText(0.000812), "0.00081");
    EXPECT_EQ(measureText(1e-9), "0");
    EXPECT_EQ(measureText(-2.5), "-2.5");
    EXPECT_EQ(measureText(std::numeric_limits<double>::infinity()), "inf");
}

TEST(Words, CompareTimes) {
    EXPECT_EQ(timesText(1.02), "about as long");
    EXPECT_EQ(timesText(3.14), "3.1 times as long");
    EXPECT_EQ(timesText(12.3), "12 times as long");
    EXPECT_EQ(timesText(0.5), "0.5 of the time");
}

TEST(Words, NameSettings) {
    EXPECT_EQ(settingText({"piecewise", "", "tolerance_px", 0.25, 1}), "`piecewise` at 0.25 px");
    EXPECT_EQ(settingText({"image-based", "cube, linear", "face_size_px", 2048, 4}),
              "`image-based` (cube, linear) with faces of 2,048 px, 4 samples");
    EXPECT_EQ(settingText({"vertex-warp", "", "tessellation_px", 8, 1}), "`vertex-warp` with edges of 8 px");
    EXPECT_EQ(settingText({"reference", "", "samples", 16, 16}), "`reference`, 16 samples");
}

TEST(Words, OfEqualPicturesAreInfinite) {
    EXPECT_EQ(decibelText(std::numeric_limits<double>::infinity()), "∞");
    EXPECT_EQ(decibelText(39.84), "39.8");
}

}  // namespace
}  // namespace curvewall
