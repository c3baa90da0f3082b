#include "calibration/projections/planar.h"

#include "calibration/errors.h"
#include "tests/support/random_numbers.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace curvewall {
namespace {

constexpr glm::ivec2 kSizePx(1920, 1080);
const PlanarScreen kSlanted{{-2, -1, -1.5}, {2, -1.1, -1}, {-2, 1, -1.2}};

TEST(Planar, CornersOfTheScreenAreCornersOfTheDisplay) {
    const glm::dvec3 eye(0.3, 0.1, 0.5);
    const PlanarProjection projection(kSlanted, eye, kSizePx);
    EXPECT_NEAR(glm::distance(*projection.unproject({0, 0}) + eye, kSlanted.upperLeftM), 0, 1e-14);
    EXPECT_NEAR(glm::distance(*projection.unproject({0, 1080}) + eye, kSlanted.lowerLeftM), 0, 1e-14);
    EXPECT_NEAR(glm::distance(*projection.unproject({1920, 1080}) + eye, kSlanted.lowerRightM), 0, 1e-14);
}

TEST(Planar, AgreesWithTheThinLensOfACentredScreen) {
    // Two metres wide, one metre ahead: x = 960 + 960 X / -Z.
    const PlanarProjection projection({{-1, -0.5625, -1}, {1, -0.5625, -1}, {-1, 0.5625, -1}}, {}, kSizePx);
    test::Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 point(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-9, -0.1));
        const auto px = projection.project(point);
        ASSERT_EQ(px.size(), 1u);
        EXPECT_NEAR(px[0].x, 960 - 960 * point.x / point.z, 1e-9);
        EXPECT_NEAR(px[0].y, 540 + 960 * point.y / point.z, 1e-9);
    }
}

TEST(Planar, EveryPixelComesBackFromAnyEye) {
    test::Random random(2);
    for (int i = 0; i < 100'000; ++i) {
        const PlanarProjection projection(
            kSlanted, {random.uniform(-2, 2), random.uniform(-1, 1), random.uniform(0, 3)}, kSizePx);
        const glm::dvec2 px = random.pixel(kSizePx);
        const auto back = projection.project(*projection.unproject(px));
        ASSERT_EQ(back.size(), 1u);
        ASSERT_LT(glm::distance(back[0], px), 1e-6);
    }
}

TEST(Planar, RaysAwayFromTheScreenAreSeenNowhere) {
    const PlanarProjection projection(kSlanted, {0, 0, 1}, kSizePx);
    EXPECT_TRUE(projection.project({0, 0, 1}).empty());
    EXPECT_TRUE(projection.project(kSlanted.lowerRightM - kSlanted.lowerLeftM).empty());
}

TEST(Planar, ScreensThatNobodyCanSeeAreRefused) {
    EXPECT_THROW(PlanarProjection({{0, 0, -1}, {1, 0, -1}, {2, 0, -1}}, {}, kSizePx), UsageError);
    EXPECT_THROW(PlanarProjection({{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}}, {}, kSizePx), UsageError);
}

}  // namespace
}  // namespace curvewall
