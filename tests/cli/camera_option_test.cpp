#include "cli/camera_option.h"

#include "calibration/errors.h"

#include <gtest/gtest.h>

#include <numbers>

namespace curvewall {
namespace {

TEST(CameraOption, ReadsPositionAndAngles) {
    const Camera camera = cameraFromText("1,-2.5,3e2,90,-45,180");
    EXPECT_EQ(camera.positionM, glm::dvec3(1, -2.5, 300));
    EXPECT_DOUBLE_EQ(camera.orientation.yawRad, std::numbers::pi / 2);
    EXPECT_DOUBLE_EQ(camera.orientation.pitchRad, -std::numbers::pi / 4);
    EXPECT_DOUBLE_EQ(camera.orientation.rollRad, std::numbers::pi);
}

TEST(CameraOption, AnglesThatAreLeftOutAreZero) {
    EXPECT_EQ(cameraFromText("1,2,3").orientation, Orientation{});
    EXPECT_DOUBLE_EQ(cameraFromText("1,2,3,180").orientation.yawRad, std::numbers::pi);
}

TEST(CameraOption, AnythingElseIsRefused) {
    for (const char* text :
         {"", "1", "1,2", "1,2,", "1,2,x", "1,2,3,4,5,6,7", "1 2 3", "1,2,3 ", "nan,0,0", "1,inf,0"})
        EXPECT_THROW(cameraFromText(text), UsageError) << text;
}

TEST(EyeOption, IsThreeNumbersOnEarth) {
    EXPECT_EQ(eyeFromText("1,-2.5,3e2"), glm::dvec3(1, -2.5, 300));
    for (const char* text : {"", "1,2", "1,2,3,4", "1,2,x", "nan,0,0", "0,0,1e300", "0,-2e7,0"})
        EXPECT_THROW(eyeFromText(text), UsageError) << text;
}

}  // namespace
}  // namespace curvewall
