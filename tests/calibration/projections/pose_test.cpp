#include "calibration/projections/pose.h"

#include "tests/support/random_numbers.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace curvewall {
namespace {

using test::kPi;
const glm::dvec3 kForward(0, 0, -1), kRight(1, 0, 0), kUp(0, 1, 0);

TEST(Pose, YawTurnsTheViewToTheRight) {
    EXPECT_NEAR(glm::distance(rotationFromOrientation({kPi / 2, 0, 0}) * kForward, kRight), 0, 1e-15);
}

TEST(Pose, PitchTurnsTheViewUp) {
    EXPECT_NEAR(glm::distance(rotationFromOrientation({0, kPi / 2, 0}) * kForward, kUp), 0, 1e-15);
}

TEST(Pose, RollTurnsTheViewerClockwise) {
    // A viewer who leans to the right has the right hand down.
    EXPECT_NEAR(glm::distance(rotationFromOrientation({0, 0, kPi / 2}) * kRight, -kUp), 0, 1e-15);
}

TEST(Pose, YawIsAppliedLast) {
    const glm::dvec3 looking = rotationFromOrientation({kPi / 2, kPi / 4, 0}) * kForward;
    EXPECT_NEAR(glm::distance(looking, glm::normalize(kRight + kUp)), 0, 1e-15);
}

void expectAnglesOf(const glm::dmat3& rotation) {
    const Orientation angles = orientationFromRotation(rotation);
    const glm::dmat3 back = rotationFromOrientation(angles);
    EXPECT_LE(std::abs(angles.pitchRad), kPi / 2);
    for (int axis = 0; axis < 3; ++axis) EXPECT_LT(glm::distance(back[axis], rotation[axis]), 1e-14);
}

TEST(Pose, AnglesComeBackFromTheirRotation) {
    test::Random random(1);
    for (int i = 0; i < 10'000; ++i) {
        const Orientation angles{random.uniform(-3.1, 3.1), random.uniform(-1.5, 1.5),
                                 random.uniform(-3.1, 3.1)};
        const Orientation back = orientationFromRotation(rotationFromOrientation(angles));
        ASSERT_NEAR(back.yawRad, angles.yawRad, 1e-13);
        ASSERT_NEAR(back.pitchRad, angles.pitchRad, 1e-13);
        ASSERT_NEAR(back.rollRad, angles.rollRad, 1e-13);
        expectAnglesOf(rotationFromOrientation({angles.yawRad, 2 * angles.pitchRad, angles.rollRad}));
    }
}

// There yaw and roll turn about one axis: any pair of the right sum will do.
TEST(Pose, RotationsStraightUpAndDownHaveAnglesToo) {
    test::Random random(2);
    for (const double offset : {0.0, 1e-16, 1e-12, 1e-9, 1e-8, 1e-6, 1e-3})
        for (const double straight : {kPi / 2, -kPi / 2})
            for (int i = 0; i < 100; ++i)
                expectAnglesOf(rotationFromOrientation(
                    {random.uniform(-3.1, 3.1), straight * (1 - offset), random.uniform(-3.1, 3.1)}));
}

}  // namespace
}  // namespace curvewall
