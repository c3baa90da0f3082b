#include "calibration/projections/cylinder.h"

#include "calibration/errors.h"
#include "tests/support/random_numbers.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace curvewall {
namespace {

using test::kPi;
constexpr glm::ivec2 kSizePx(1600, 1200);

TEST(Cylinder, MiddleColumnLooksAheadAndXGrowsToTheRight) {
    const CylinderProjection projection(test::fullCylinder(kSizePx), {}, kSizePx);
    EXPECT_NEAR(glm::distance(*projection.unproject({800, 600}), glm::dvec3(0, 0, -2)), 0, 1e-14);
    EXPECT_NEAR(glm::distance(*projection.unproject({1200, 600}), glm::dvec3(2, 0, 0)), 0, 1e-14);
    EXPECT_GT(projection.unproject({800, 100})->y, 0);  // row 0 is up
}

TEST(Cylinder, AgreesWithItsClosedFormFromTheAxis) {
    // x is linear in azimuth, y in the tangent of elevation.
    const CylinderWall wall = test::fullCylinder(kSizePx);
    const CylinderProjection projection(wall, {}, kSizePx);
    test::Random random(1);
    for (int i = 0; i < 100'000; ++i) {
        const glm::dvec3 ray = random.direction() * random.uniform(0.1, 10);
        const double x = 1600 * (std::atan2(ray.x, -ray.z) / (2 * kPi) + 0.5);
        const double y = 1200 * (0.5 - 2 * ray.y / std::hypot(ray.x, ray.z) / wall.heightM);
        const auto px = projection.project(ray);
        ASSERT_EQ(px.size(), 1u);
        ASSERT_LT(std::abs(px[0].x - x), 1e-9);
        ASSERT_LT(std::abs(px[0].y - y), 1e-9 * (1 + std::abs(y)));
    }
}

TEST(Cylinder, EveryPixelComesBackFromAnyEyeInside) {
    test::Random random(2);
    for (int i = 0; i < 100'000; ++i) {
        CylinderWall wall{random.uniform(0.5, 20),
                          random.uniform(0.01, 2 * kPi),
                          random.uniform(0.5, 10),
                          random.inBox(5),
                          {random.uniform(-3, 3), random.uniform(-1, 1), random.uniform(-1, 1)}};
        if (i % 2) wall.arcRad = 2 * kPi;
        const double offAxis = random.uniform(0, 0.99) * wall.radiusM, azimuth = random.uniform(-kPi, kPi);
        const glm::dvec3 eye =
            wall.centerM +
            rotationFromOrientation(wall.orientation) *
                glm::dvec3(offAxis * std::sin(azimuth), random.uniform(-3, 3), offAxis * std::cos(azimuth));
        const CylinderProjection projection(wall, eye, kSizePx);
        const glm::dvec2 px = random.pixel(kSizePx);
        const auto back = projection.project(*projection.unproject(px));
        ASSERT_EQ(back.size(), 1u);
        glm::dvec2 off = glm::abs(back[0] - px);
        if (i % 2) off.x = std::min(off.x, 1600 - off.x);  // modulo the width on a full turn
        ASSERT_LT(glm::length(off), 1e-6) << "pixel " << px.x << ", " << px.y;
    }
}

TEST(Cylinder, FullTurnWrapsIntoTheDisplay) {
    const CylinderProjection projection(test::fullCylinder(kSizePx), {}, kSizePx);
    for (double x : {-1e-17, 0.0, 1e-17, -1e-9, 1e-9}) {
        const double px = projection.project({x, 0, 1})[0].x;
        EXPECT_GE(px, 0);
        EXPECT_LT(px, 1600);
    }
}

TEST(Cylinder, MoreThanATurnShowsARayInEveryColumnThatSeesIt) {
    CylinderWall wall = test::fullCylinder(kSizePx);
    wall.arcRad = 3 * kPi;
    const CylinderProjection projection(wall, {0.3, 0.1, -0.4}, kSizePx);
    const double turnPx = 1600 / 1.5;
    test::Random random(3);
    for (int i = 0; i < 10'000; ++i) {
        const glm::dvec2 px = random.pixel(kSizePx);
        const auto positions = projection.project(*projection.unproject(px));
        ASSERT_EQ(positions.size(), px.x < 1600 - turnPx || px.x > turnPx ? 2u : 1u);
        const size_t turn = px.x > turnPx ? 1 : 0;
        ASSERT_LT(glm::distance(positions[turn], px), 1e-6);
    }
}

TEST(Cylinder, RaysAlongTheAxisAreSeenNowhere) {
    const CylinderProjection projection(test::fullCylinder(kSizePx), {}, kSizePx);
    EXPECT_TRUE(projection.project({0, 1, 0}).empty());
}

TEST(Cylinder, EyesOutsideAreRefused) {
    EXPECT_THROW(CylinderProjection(test::fullCylinder(kSizePx), {2.0, 0, 0}, kSizePx), UsageError);
    EXPECT_THROW(CylinderProjection(test::fullCylinder(kSizePx), {1.5, 0, 1.5}, kSizePx), UsageError);
    EXPECT_NO_THROW(CylinderProjection(test::fullCylinder(kSizePx), {1.99, 50, 0}, kSizePx));
}

}  // namespace
}  // namespace curvewall
