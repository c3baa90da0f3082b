#include "calibration/formats/blend_files.h"

#include "calibration/errors.h"
#include "calibration/files/map_file.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace curvewall {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class BlendFiles : public ::testing::Test {
protected:
    FileBytes picture(glm::ivec2 sizePx, int channels, const std::vector<float>& values) {
        const std::string path = folder_.path("mask.png");
        writePng16(path, {sizePx, channels, true, values});
        return readFile(path, "a picture");
    }
    std::vector<glm::vec3> read(const FileBytes& file, glm::ivec2 sizePx, double gamma = 1) {
        return readBlendPicture(file, sizePx, gamma, "left wall", decisions_);
    }

    test::TemporaryFolder folder_;
    Decisions decisions_;
};

TEST_F(BlendFiles, GreyCountsForAllChannelsAndBecomesLinear) {
    const auto light = read(picture({2, 1}, 1, {0.5f, 1}), {2, 1}, 2.2);
    EXPECT_NEAR(light[0].r, std::pow(0.5, 2.2), 2e-5);  // 16 bits
    EXPECT_EQ(light[0].g, light[0].r);
    EXPECT_EQ(light[0].b, light[0].r);
    EXPECT_EQ(light[1], glm::vec3(1));
    EXPECT_THAT(decisions_.warnings(), IsEmpty());
}

TEST_F(BlendFiles, ChannelsOfAColourPictureStayApart) {
    const auto light = read(picture({1, 1}, 3, {1, 0, 0.2f}), {1, 1});
    EXPECT_EQ(light[0].r, 1);
    EXPECT_EQ(light[0].g, 0);
    EXPECT_NEAR(light[0].b, 0.2, 2e-5);
}

TEST_F(BlendFiles, AnotherSizeIsResampledBetweenTexelCentresWithAWarning) {
    const auto light = read(picture({2, 1}, 1, {0, 1}), {4, 2});
    // Centres at 1/8, 3/8, 5/8, 7/8 of the width; the texels' at 1/4 and 3/4.
    for (const size_t row : {0u, 4u}) {
        EXPECT_NEAR(light[row + 0].r, 0, 1e-6);
        EXPECT_NEAR(light[row + 1].r, 0.25, 1e-6);
        EXPECT_NEAR(light[row + 2].r, 0.75, 1e-6);
        EXPECT_NEAR(light[row + 3].r, 1, 1e-6);
    }
    EXPECT_THAT(decisions_.warnings(),
                ElementsAre("left wall: mask.png has 2 x 1 pixels and the display 4 x 2; it is resampled"));
}

TEST_F(BlendFiles, AnAlphaChannelThatSaysSomethingIsReported) {
    EXPECT_EQ(read(picture({1, 1}, 2, {1, 1}), {1, 1})[0], glm::vec3(1));
    EXPECT_THAT(decisions_.warnings(), IsEmpty());
    EXPECT_EQ(read(picture({1, 1}, 2, {1, 0.5f}), {1, 1})[0], glm::vec3(1));
    EXPECT_THAT(decisions_.warnings(), ElementsAre(HasSubstr("alpha channel of mask.png")));
}

TEST_F(BlendFiles, WhatIsNoPictureIsRefused) {
    const FileBytes file = readFile(folder_.write("mask.png", "no picture"), "a picture");
    EXPECT_THROW(read(file, {1, 1}), InputError);
}

TEST_F(BlendFiles, ValuesBeyondOneAreRefusedWithTheirPlace) {
    // One float that is 2, little-endian.
    const FileBytes file =
        readFile(folder_.write("mask.pfm", std::string("Pf\n1 1\n-1.0\n\0\0\0\x40", 16)), "a picture");
    try {
        read(file, {1, 1});
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(),
                    HasSubstr("mask.pfm: expected values from 0 to 1, found 2 at pixel (0, 0)"));
    }
}

}  // namespace
}  // namespace curvewall
