// Masks judged from outside: the test follows rays by the exact projections and adds up what is shown there.

#include "calibration/blending/blend_masks.h"

#include "calibration/projections/cylinder.h"
#include "calibration/projections/planar.h"
#include "tests/support/blend_sum.h"
#include "tests/support/random_numbers.h"
#include "tests/support/test_projections.h"
#include "tests/support/test_walls.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

using test::bilinear, test::BlendedLight, test::blendedLight, test::distanceToBorderPx, test::maskAt;

Display planarDisplay(test::Random& random, std::string name) {
    const Orientation turn{random.uniform(-0.6, 0.6), random.uniform(-0.3, 0.3), random.uniform(-0.5, 0.5)};
    const glm::dmat3 rotation = rotationFromOrientation(turn);
    const glm::dvec3 center = random.inBox(0.2);
    const double x = random.uniform(0.7, 1.3), y = x * random.uniform(0.6, 0.9);
    const auto corner = [&](double right, double up) {
        return center + rotation * glm::dvec3(right * x, up * y, -1.5);
    };
    const glm::ivec2 size(random.uniform(320, 480), random.uniform(240, 360));
    const PlanarScreen screen{corner(-1, -1), corner(1, -1), corner(-1, 1)};
    return {std::move(name), size, "planar", std::make_shared<PlanarProjection>(screen, glm::dvec3(0), size)};
}

Display cylinderDisplay(test::Random& random, std::string name) {
    const CylinderWall cylinder{
        2,
        random.uniform(0.8, 1.6),
        random.uniform(1.5, 2.5),
        random.inBox(0.2),
        {random.uniform(-0.6, 0.6), random.uniform(-0.3, 0.3), random.uniform(-0.5, 0.5)}};
    const glm::ivec2 size(random.uniform(320, 480), random.uniform(240, 360));
    return {std::move(name), size, "cylinder",
            std::make_shared<CylinderProjection>(cylinder, glm::dvec3(0), size)};
}

Wall randomWall(test::Random& random) {
    Wall wall;
    const int count = static_cast<int>(random.uniform(2, 6));
    for (int i = 0; i < count; ++i)
        wall.displays.push_back(random.uniform(0, 1) < 0.5 ? planarDisplay(random, std::to_string(i))
                                                           : cylinderDisplay(random, std::to_string(i)));
    return wall;
}

// A position anywhere or, half the time, within 3 px of a border.
glm::dvec2 randomPosition(test::Random& random, glm::ivec2 sizePx) {
    glm::dvec2 px = random.pixel(sizePx);
    if (random.uniform(0, 1) < 0.5) return px;
    const int axis = random.uniform(0, 1) < 0.5 ? 0 : 1;
    px[axis] = random.uniform(0, 1) < 0.5 ? random.uniform(0, 3) : sizePx[axis] - random.uniform(0, 3);
    return px;
}

TEST(BlendMasks, SumToOneOnEveryRayThatTheWallShows) {
    test::Random random(1);
    for (int round = 0; round < 20; ++round) {
        const Wall wall = randomWall(random);
        const BlendMasks masks = makeBlendMasks(wall);
        for (const BlendMask& mask : masks.displays)
            for (const float value : mask.values) ASSERT_TRUE(value >= 0 && value <= 1);
        int overlapping = 0, off = 0, nearBorder = 0;
        constexpr int kRays = 20000;
        for (int i = 0; i < kRays; ++i) {
            const Display& display = wall.displays[static_cast<size_t>(i) % wall.displays.size()];
            const BlendedLight sum = blendedLight(
                wall, masks, *display.projection->unproject(randomPosition(random, display.sizePx)));
            overlapping += sum.displays > 1;
            nearBorder += sum.bordersNear == 1;
            off += std::abs(sum.light - 1) > 0.01;
            // Where the borders of two displays meet, both masks end in one point and no pixels can follow.
            if (sum.bordersNear < 2) {
                ASSERT_NEAR(sum.light, 1, 0.01) << "round " << round;
            }
        }
        EXPECT_GT(overlapping, kRays / 10);
        EXPECT_GT(nearBorder, kRays / 10);
        EXPECT_LT(off, kRays / 100);  // half of the rays lie where this can happen at all
    }
}

TEST(BlendMasks, FallToZeroAtABorderInsideAnotherDisplayAndStayOneWhereTheyAreAlone) {
    test::Random random(2);
    int borders = 0, alone = 0;
    for (int round = 0; round < 6; ++round) {
        const Wall wall = randomWall(random);
        const BlendMasks masks = makeBlendMasks(wall);
        for (size_t i = 0; i < wall.displays.size(); ++i) {
            const Display& display = wall.displays[i];
            for (int y = 0; y < display.sizePx.y; ++y)
                for (int x = 0; x < display.sizePx.x; ++x) {
                    const glm::dvec2 px(x + 0.5, y + 0.5);
                    double deepest = -1e9;  // how far inside another display
                    for (size_t k = 0; k < wall.displays.size(); ++k)
                        for (const glm::dvec2 there :
                             wall.displays[k].projection->project(*display.projection->unproject(px)))
                            if (k != i)
                                deepest =
                                    std::max(deepest, distanceToBorderPx(wall.displays[k].sizePx, there));
                    const float value = maskAt(masks.displays[i], display.sizePx, x, y);
                    if (deepest < 0) {
                        ASSERT_EQ(value, 1) << round << ": " << x << ", " << y;
                        ++alone;
                    } else if (deepest > 40 && distanceToBorderPx(display.sizePx, px) < 1) {
                        ASSERT_LT(value, 0.01) << round << ": " << x << ", " << y;
                        ++borders;
                    }
                }
        }
    }
    EXPECT_GT(borders, 500);
    EXPECT_GT(alone, 100000);
}

// The steepest step from one pixel to the next.
double largestStep(const BlendMask& mask, glm::ivec2 sizePx) {
    double largest = 0;
    for (int y = 0; y < sizePx.y; ++y)
        for (int x = 0; x + 1 < sizePx.x; ++x)
            largest = std::max<double>(largest,
                                       std::abs(maskAt(mask, sizePx, x, y) - maskAt(mask, sizePx, x + 1, y)));
    return largest;
}

// Two screens side by side in one plane, the eye before the middle of both: pixels are squares of 1/100 m,
// `overlapPx` columns are shared.
Wall twoScreens(int overlapPx) {
    Wall wall;
    const glm::ivec2 size(300, 200);
    for (int i = 0; i < 2; ++i) {
        const double left = (i == 0 ? -3 : 0) + (i == 0 ? 1 : -1) * overlapPx / 200.0;
        const PlanarScreen screen{{left, -1, -2}, {left + 3, -1, -2}, {left, 1, -2}};
        wall.displays.push_back({i == 0 ? "left" : "right", size, "planar",
                                 std::make_shared<PlanarProjection>(screen, glm::dvec3(0), size)});
    }
    return wall;
}

TEST(BlendMasks, ScreensThatEndAtTheSameLineAboveAndBelowAreRampedSideways) {
    const BlendMasks masks = makeBlendMasks(twoScreens(100));
    const glm::ivec2 size(300, 200);
    for (int x = 0; x < 300; ++x)
        for (int y = 0; y < 200; ++y)
            EXPECT_NEAR(maskAt(masks.displays[0], size, x, y), maskAt(masks.displays[0], size, x, 100), 1e-4);
    EXPECT_NEAR(maskAt(masks.displays[0], size, 249, 0) + maskAt(masks.displays[0], size, 250, 0), 1, 0.002);
    EXPECT_LT(largestStep(masks.displays[0], size), 2.5 / 100);
    EXPECT_NEAR(masks.displays[0].overlapShare, 1.0 / 3, 1e-9);
    EXPECT_LT(masks.sum.largestDeviation, 3.0 / 65535);
    EXPECT_EQ(masks.sum.shareOff, 0);
}

TEST(BlendMasks, DisplaysThatDoNotOverlapKeepFullLight) {
    Wall wall = twoScreens(0);
    for (const BlendMask& mask : makeBlendMasks(wall).displays) {
        EXPECT_EQ(mask.overlapShare, 0);
        EXPECT_EQ(std::ranges::count(mask.values, 1.0f), 300 * 200);
    }
    wall.displays.pop_back();
    EXPECT_EQ(std::ranges::count(makeBlendMasks(wall).displays[0].values, 1.0f), 300 * 200);
    // A full turn meets itself, which is no overlap.
    EXPECT_EQ(makeBlendMasks(test::fullCylinderWall({160, 120})).displays[0].overlapShare, 0);
}

TEST(BlendMasks, TwoDisplaysOnTheSameSpotShareTheLight) {
    Wall wall = twoScreens(300);
    for (const BlendMask& mask : makeBlendMasks(wall).displays)
        for (const float value : mask.values) ASSERT_NEAR(value, 0.5, 1e-4);
}

TEST(BlendMasks, APixelsWorthOfViewCountsAndNotTheNumberOfPixels) {
    // The same two screens with three times the pixels on the right: light meets in the same places.
    Wall wall = twoScreens(100);
    wall.displays[1].sizePx = {900, 600};
    wall.displays[1].projection = std::make_shared<PlanarProjection>(
        PlanarScreen{{-0.5, -1, -2}, {2.5, -1, -2}, {-0.5, 1, -2}}, glm::dvec3(0), glm::ivec2(900, 600));
    const BlendMasks masks = makeBlendMasks(wall), even = makeBlendMasks(twoScreens(100));
    for (int x = 0; x < 300; ++x)
        EXPECT_NEAR(maskAt(masks.displays[0], {300, 200}, x, 90), maskAt(even.displays[0], {300, 200}, x, 90),
                    0.02);
}

// A screen that shows nothing within a disc, or nothing outside of it.
class Holed : public PinholeProjection {
public:
    Holed(glm::ivec2 sizePx, double focalPx, double radiusPx, bool showsInside)
        : PinholeProjection(sizePx, focalPx),
          middlePx_(glm::dvec2(sizePx) / 2.0),
          radiusPx_(radiusPx),
          showsInside_(showsInside) {}

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override {
        return shows(px) ? PinholeProjection::unproject(px) : std::nullopt;
    }
    std::vector<glm::dvec2> project(glm::dvec3 ray) const override {
        auto positions = PinholeProjection::project(ray);
        std::erase_if(positions, [this](glm::dvec2 px) { return !shows(px); });
        return positions;
    }

private:
    bool shows(glm::dvec2 px) const { return (glm::distance(px, middlePx_) < radiusPx_) == showsInside_; }

    glm::dvec2 middlePx_;
    double radiusPx_;
    bool showsInside_;
};

TEST(BlendMasks, HolesWithinAnotherDisplayAreFilledByIt) {
    Wall wall;
    const glm::ivec2 size(300, 200);
    wall.displays.push_back({"holed", size, "test", std::make_shared<Holed>(size, 200, 40, false)});
    wall.displays.push_back({"full", size, "test", std::make_shared<PinholeProjection>(size, 200)});
    const BlendMasks masks = makeBlendMasks(wall);
    EXPECT_EQ(maskAt(masks.displays[0], size, 150, 100), 0);
    EXPECT_EQ(maskAt(masks.displays[1], size, 150, 100), 1);
    EXPECT_LT(maskAt(masks.displays[0], size, 191, 100), 0.01);  // beside the hole
    EXPECT_GT(maskAt(masks.displays[1], size, 191, 100), 0.99);
    EXPECT_LT(masks.sum.largestDeviation, 0.01);
}

TEST(BlendMasks, ADiscThatOverlapsFallsToZeroAlongItsEdge) {
    Wall wall = {};
    const glm::ivec2 size(300, 200);
    wall.displays.push_back({"disc", size, "test", std::make_shared<Holed>(size, 200, 90, true)});
    wall.displays.push_back({"full", size, "test", std::make_shared<PinholeProjection>(size, 100)});
    const BlendMasks masks = makeBlendMasks(wall);
    for (int i = 0; i < 64; ++i) {
        const double angle = 2 * test::kPi * i / 64;
        const glm::dvec2 px = glm::dvec2(150, 100) + 88.5 * glm::dvec2(std::cos(angle), std::sin(angle));
        EXPECT_LT(bilinear(masks.displays[0], size, px), 0.01);
    }
    EXPECT_EQ(maskAt(masks.displays[0], size, 2, 2), 0);
    EXPECT_EQ(maskAt(masks.displays[1], size, 2, 2), 1);
}

TEST(BlendMasks, AreTheSameEveryTime) {
    test::Random random(4);
    const Wall wall = randomWall(random);
    const BlendMasks first = makeBlendMasks(wall), second = makeBlendMasks(wall);
    for (size_t i = 0; i < wall.displays.size(); ++i)
        EXPECT_EQ(first.displays[i].values, second.displays[i].values);
}

TEST(BlendMasks, ReportWhatTheTestFindsAtPixelCentres) {
    test::Random random(5);
    const Wall wall = randomWall(random);
    const BlendMasks masks = makeBlendMasks(wall);
    double largest = 0;
    size_t pixels = 0, off = 0;
    for (const Display& display : wall.displays)
        for (int y = 0; y < display.sizePx.y; ++y)
            for (int x = 0; x < display.sizePx.x; ++x) {
                const double deviation = std::abs(
                    blendedLight(wall, masks, *display.projection->unproject({x + 0.5, y + 0.5})).light - 1);
                largest = std::max(largest, deviation);
                off += deviation > 0.01;
                ++pixels;
            }
    EXPECT_NEAR(masks.sum.largestDeviation, largest, 1e-4);
    EXPECT_NEAR(masks.sum.shareOff, static_cast<double>(off) / static_cast<double>(pixels), 1e-5);
    const Display& worst = wall.displays[masks.sum.display];
    const auto ray = worst.projection->unproject(glm::dvec2(masks.sum.pixel) + 0.5);
    EXPECT_NEAR(std::abs(blendedLight(wall, masks, *ray).light - 1), largest, 1e-4);
}

}  // namespace
}  // namespace curvewall
