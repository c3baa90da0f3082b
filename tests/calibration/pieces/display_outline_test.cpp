#include "calibration/pieces/display_outline.h"

#include "tests/support/broken_displays.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

namespace curvewall {
namespace {

std::vector<HalfPlane> outlineOf(test::RayAt rays, glm::ivec2 sizePx) {
    return displayOutline(RayFunctionProjection(std::move(rays)), sizePx);
}

TEST(DisplayOutline, ADisplayWithoutHolesHasItsFourSides) {
    const glm::ivec2 size(640, 480);
    const std::vector<HalfPlane> outline = outlineOf(test::flatRays(size), size);
    ASSERT_EQ(outline.size(), 4u);
    for (const HalfPlane& side : outline) {
        EXPECT_NEAR(glm::length(side.normal), 1, 1e-12);
        for (glm::dvec2 corner : {glm::dvec2(0, 0), {640, 0}, {0, 480}, {640, 480}})
            EXPECT_GE(side.depthOf(corner), -1e-9);
        EXPECT_NEAR(side.depthOf({320, 240}), side.normal.x == 0 ? 240 : 320, 1e-9);
    }
}

TEST(DisplayOutline, ARoundDisplayHasTangents) {
    const glm::ivec2 size(1600, 1200);
    const std::vector<HalfPlane> outline = outlineOf(test::fisheyeRays(size), size);
    EXPECT_GT(outline.size(), 30u);
    for (const HalfPlane& side : outline) EXPECT_NEAR(side.depthOf({800, 600}), 600, 0.5);
}

TEST(DisplayOutline, NoRayIsOutsideOfIt) {
    const glm::ivec2 size(500, 300);
    test::Random random(3);
    for (int i = 0; i < 20; ++i) {
        const glm::dvec2 centre(random.uniform(100, 400), random.uniform(80, 220));
        const double radius = random.uniform(40, 200);
        const auto rays = test::withHoles(test::flatRays(size), [=](glm::dvec2 px) {
            const bool isOnDisplay = glm::all(glm::greaterThanEqual(px, glm::dvec2(0))) &&
                                     glm::all(glm::lessThanEqual(px, glm::dvec2(500, 300)));
            return !isOnDisplay || glm::distance(px, centre) > radius;
        });
        const std::vector<HalfPlane> outline = outlineOf(rays, size);
        double leastDepth = 1e9;
        for (int k = 0; k < 2000; ++k) {
            const glm::dvec2 px(random.uniform(0, 500), random.uniform(0, 300));
            if (!rays(px)) continue;
            for (const HalfPlane& side : outline) leastDepth = std::min(leastDepth, side.depthOf(px));
        }
        EXPECT_GE(leastDepth, -1);
        EXPECT_LE(leastDepth, 20);
    }
}

TEST(DisplayOutline, NothingHasNone) {
    EXPECT_TRUE(outlineOf([](glm::dvec2) { return std::nullopt; }, {64, 48}).empty());
}

}  // namespace
}  // namespace curvewall
