#include "renderer/display_facts.h"

#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"
#include "tests/support/test_projections.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace curvewall {
namespace {

constexpr double kPi = test::kPi;

Wall fisheyeWall(double fovDeg, glm::ivec2 sizePx) {
    const RadialFunction equidistant{RadialModel::equidistant, {}};
    return wallOf(std::make_shared<LensProjection>(circularLens(equidistant, fovDeg * kPi / 180, sizePx),
                                                   Orientation{}),
                  sizePx);
}

TEST(DisplayFacts, OfAPlaneAreThoseOfItsFormulas) {
    const DisplayFacts facts = factsOf(test::planarWall({800, 600}, 90).displays.front());
    EXPECT_NEAR(facts.shownPx, 800 * 600, 1);
    // A rectangle of 2 a x 2 b at distance 1 fills 4 asin(a b / sqrt((1 + a^2)(1 + b^2))).
    const double a = 1, b = 0.75;
    EXPECT_NEAR(facts.solidAngleSr, 4 * std::asin(a * b / std::sqrt((1 + a * a) * (1 + b * b))), 0.01);
    EXPECT_NEAR(facts.axis.z, -1, 1e-6);
    EXPECT_GE(facts.reachRad, std::atan(std::hypot(a, b)));
    EXPECT_LT(facts.reachRad, std::atan(std::hypot(a, b)) + 0.05);
}

// Lines stay lines, but the middle of two rays is not in the middle of their pixels.
TEST(DisplayFacts, APlaneBendsLessTheNarrowerItIs) {
    const double wide = factsOf(test::planarWall({800, 800}, 120).displays.front()).bendPx;
    const double narrow = factsOf(test::planarWall({800, 800}, 20).displays.front()).bendPx;
    EXPECT_GT(wide, 10 * narrow);
    EXPECT_GT(narrow, 0);
}

TEST(DisplayFacts, OfAFullTurnHaveNoMiddle) {
    const DisplayFacts facts = factsOf(test::fullCylinderWall({1600, 1200}).displays.front());
    EXPECT_EQ(facts.reachRad, kPi);
    EXPECT_LT(facts.solidAngleSr, 4 * kPi);
    EXPECT_GT(facts.solidAngleSr, 2 * kPi);
    EXPECT_TRUE(std::isfinite(facts.bendPx));
}

TEST(DisplayFacts, ADomeSeesHalfTheSphereInItsCircle) {
    const DisplayFacts facts = factsOf(fisheyeWall(180, {1024, 1024}).displays.front());
    EXPECT_NEAR(facts.solidAngleSr, 2 * kPi, 0.05);
    EXPECT_NEAR(facts.shownPx, kPi * 512 * 512, 0.02 * kPi * 512 * 512);
    EXPECT_NEAR(facts.reachRad, kPi / 2, 0.1);
}

TEST(DisplayFacts, ABendOfTwiceTheLengthIsFourTimesAsFar) {
    const DisplayFacts facts = factsOf(fisheyeWall(180, {1024, 1024}).displays.front());
    EXPECT_NEAR(strokeErrorPx(facts, 20), 4 * strokeErrorPx(facts, 10), 1e-9);
    // The horizon is a circle of 512 px: its chord of 10 px has a sagitta of 10^2 / (8 * 512).
    EXPECT_NEAR(strokeErrorPx(facts, 10), 100.0 / (8 * 512), 0.35 * 100.0 / (8 * 512));
}

}  // namespace
}  // namespace curvewall
