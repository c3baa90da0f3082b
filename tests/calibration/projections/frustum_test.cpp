#include "calibration/projections/frustum.h"

#include "calibration/errors.h"
#include "tests/support/random_numbers.h"
#include "tests/support/round_trip.h"

#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace curvewall {
namespace {

constexpr glm::ivec2 kSizePx(640, 480);

TEST(FrustumProjection, CornersLieAtItsAngles) {
    const Frustum frustum{
        glm::radians(-60.0), glm::radians(20.0), glm::radians(10.0), glm::radians(50.0), {}};
    const FrustumProjection projection(frustum, kSizePx);
    const glm::dvec3 topLeft = *projection.unproject({0, 0}), bottomRight = *projection.unproject(kSizePx);
    EXPECT_NEAR(glm::degrees(std::atan2(topLeft.x, -topLeft.z)), -60, 1e-12);
    EXPECT_NEAR(glm::degrees(std::atan2(topLeft.y, -topLeft.z)), 50, 1e-12);
    EXPECT_NEAR(glm::degrees(std::atan2(bottomRight.x, -bottomRight.z)), 20, 1e-12);
    EXPECT_NEAR(glm::degrees(std::atan2(bottomRight.y, -bottomRight.z)), 10, 1e-12);
    EXPECT_DOUBLE_EQ(topLeft.z, -1);
}

TEST(FrustumProjection, TurnsRightUpAndClockwise) {
    const Frustum right{-0.5, 0.5, -0.4, 0.4, {glm::radians(90.0), 0, 0}};
    EXPECT_NEAR(FrustumProjection(right, kSizePx).unproject({320, 240})->x, 1, 1e-12);
    const Frustum up{-0.5, 0.5, -0.4, 0.4, {0, glm::radians(90.0), 0}};
    EXPECT_NEAR(FrustumProjection(up, kSizePx).unproject({320, 240})->y, 1, 1e-12);
    const Frustum rolled{-0.5, 0.5, -0.4, 0.4, {0, 0, glm::radians(90.0)}};
    EXPECT_GT(FrustumProjection(rolled, kSizePx).unproject({320, 0})->x, 0.4);  // the top leans right
}

TEST(FrustumProjection, PixelsComeBackWhateverTheFrustum) {
    test::Random random(61);
    for (int i = 0; i < 20; ++i) {
        const double left = random.uniform(-1.5, 1.2), down = random.uniform(-1.5, 1.2);
        const Frustum frustum{left, random.uniform(left + 0.1, 1.5), down, random.uniform(down + 0.1, 1.5),
                              test::anyOrientation(random)};
        const test::RoundTrip back = test::roundTrip(FrustumProjection(frustum, kSizePx), kSizePx, 7);
        EXPECT_LT(back.worstPx, 1e-6);
        EXPECT_EQ(back.holes, 0);
    }
}

TEST(FrustumProjection, NothingBehindTheEyeIsSeen) {
    const FrustumProjection projection({-0.5, 0.5, -0.4, 0.4, {}}, kSizePx);
    EXPECT_TRUE(projection.project({0, 0, 1}).empty());
    EXPECT_TRUE(projection.project({1, 0, 0}).empty());
    EXPECT_EQ(projection.project({0, 0, -3}).size(), 1U);
}

TEST(FrustumProjection, RefusesWhatHasNoAreaOrReachesAQuarterTurn) {
    const double kNan = std::numeric_limits<double>::quiet_NaN();
    for (const Frustum& frustum : {Frustum{0.5, -0.5, -0.4, 0.4, {}}, Frustum{0.5, 0.5, -0.4, 0.4, {}},
                                   Frustum{-0.5, 0.5, 0.4, -0.4, {}}, Frustum{-1.6, 0.5, -0.4, 0.4, {}},
                                   Frustum{-0.5, 0.5, -0.4, 1.5708, {}}, Frustum{kNan, 0.5, -0.4, 0.4, {}}})
        EXPECT_THROW(FrustumProjection(frustum, kSizePx), UsageError);
}

}  // namespace
}  // namespace curvewall
