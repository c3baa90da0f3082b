#include "calibration/projections/pose.h"

#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace curvewall
