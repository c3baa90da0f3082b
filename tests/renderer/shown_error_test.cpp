#include "renderer/shown_error.h"

#include "calibration/pieces/pixel_rays.h"
#include "tests/support/lens_walls.h"
#include "tests/support/small_walls.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvewall {
namespace {

// What a display shows where each pixel shows what belongs `offPx` beside its centre, at any distance.
Frame pictureOffBy(const Display& display, glm::dvec2 offPx) {
    Frame frame{display.sizePx, 3, {}};
    for (int y = 0; y < display.sizePx.y; ++y)
        for (int x = 0; x < display.sizePx.x; ++x) {
            const auto ray = display.projection->unproject(centreOf({x, y}) + offPx);
            for (int i = 0; i < 3; ++i)
                frame.texels.push_back(ray ? static_cast<float>((1.0 + x + y) * (*ray)[i])
                                           : std::numeric_limits<float>::quiet_NaN());
        }
    return frame;
}

TEST(ShownError, IsTheDistanceFromThePixelToWhatItShows) {
    const Wall wall = test::planarWall({40, 30}, 60);
    const Display& display = wall.displays.front();
    EXPECT_LT(shownError(pictureOffBy(display, {0, 0}), display).maxPx, 1e-4);
    const Certificate error = shownError(pictureOffBy(display, {0.3, -0.4}), display);
    EXPECT_NEAR(error.maxPx, 0.5, 1e-4);
    EXPECT_NEAR(error.meanPx, 0.5, 1e-4);
}

TEST(ShownError, GoesTheShorterWayAroundAClosedDisplay) {
    const Wall wall = test::fullCylinderWall({64, 16});
    const Display& display = wall.displays.front();
    EXPECT_NEAR(shownError(pictureOffBy(display, {-2, 0}), display).maxPx, 2, 1e-3);
    EXPECT_NEAR(shownError(pictureOffBy(display, {2, 0}), display).maxPx, 2, 1e-3);
}

TEST(ShownError, CountsWhatBelongsNowhereAsInfinitelyFar) {
    const Wall wall = test::planarWall({4, 4}, 60);
    const Display& display = wall.displays.front();
    Frame frame = pictureOffBy(display, {0, 0});
    frame.texels[2] = -frame.texels[2];  // behind the screen
    EXPECT_TRUE(std::isinf(shownError(frame, display).maxPx));
    frame.texels[0] = std::numeric_limits<float>::quiet_NaN();  // nothing is shown there
    EXPECT_LT(shownError(frame, display).maxPx, 1e-4);
}

// Asks of each pixel whose place `asidePx` from the middle shows nothing how far off the last ray before that
// is, a hair further: by how much that differs from the truth.
struct Told {
    int count = 0, nowhere = 0;
    double leastPx = 1e9, mostPx = 0;
};

Told toldBeyondTheBorder(const Display& display, double asidePx) {
    const PixelDistance distance(display);
    Told told;
    const auto rayAt = [&](glm::dvec2 px) { return display.projection->unproject(px); };
    for (int y = 0; y < display.sizePx.y; ++y)
        for (int x = 0; x < display.sizePx.x; ++x)
            for (const glm::dvec2 way :
                 {glm::dvec2(1, 0), glm::dvec2(-1, 0), glm::dvec2(0, 1), glm::dvec2(0, -1)}) {
                const glm::dvec2 px = centreOf({x, y});
                if (!rayAt(px) || !rayAt(px - 0.5 * way) || rayAt(px + asidePx * way)) continue;
                // The last place with a ray, and a hair further.
                double inside = 0, outside = asidePx;
                for (int i = 0; i < 60; ++i) {
                    const double between = 0.5 * (inside + outside);
                    (rayAt(px + between * way) ? inside : outside) = between;
                }
                const glm::dvec3 last = glm::normalize(*rayAt(px + inside * way)),
                                 before = glm::normalize(*rayAt(px + (inside - 0.01) * way));
                const glm::dvec3 beyond = last + 1e-5 * glm::normalize(last - before);
                if (!display.projection->project(beyond).empty()) continue;
                ++told.count;
                const auto toldPx = distance.from(px, beyond);
                told.nowhere += !toldPx;
                if (!toldPx) continue;
                told.leastPx = std::min(told.leastPx, *toldPx - inside);
                told.mostPx = std::max(told.mostPx, *toldPx - inside);
            }
    return told;
}

TEST(ShownError, GoesStraightOnAcrossABorderBeyondWhichNothingIsKnown) {
    const test::LensKind halfTurn{"Orthographic180", {RadialModel::orthographic}, 180};
    for (const Wall& wall :
         {test::lensWall(halfTurn, {200, 200}), test::smallShippedWall("camera-texture", 5)}) {
        const Told told = toldBeyondTheBorder(wall.displays[0], 0.75);
        EXPECT_GT(told.count, 100) << wall.name;
        EXPECT_EQ(told.nowhere, 0) << wall.name;
        EXPECT_GT(told.leastPx, -0.01) << wall.name;
        EXPECT_LT(told.mostPx, 1) << wall.name;
    }
}

// What lies behind the rim of a full turn is seen by the rim's other side, and is that far off.
TEST(ShownError, IsKnownAllAroundAFullTurn) {
    const Wall wall = test::lensWall({"Equidistant360", {RadialModel::equidistant}, 360}, {200, 200});
    EXPECT_EQ(toldBeyondTheBorder(wall.displays[0], 0.75).count, 0);
    const PixelDistance distance(wall.displays[0]);
    const auto rim = wall.displays[0].projection->unproject({100, 199.5});
    ASSERT_TRUE(rim);
    EXPECT_LT(distance.from({100, 199.5}, *rim).value_or(1e9), 1e-6);
    EXPECT_NEAR(distance.from({100, 199.5}, glm::dvec3(1, -1, 1) * *rim).value_or(1e9), 199, 1e-3);
}

TEST(ShownError, StaysInfiniteFarBeyondABorder) {
    const Wall wall = test::lensWall({"Orthographic180", {RadialModel::orthographic}, 180}, {200, 200});
    const PixelDistance distance(wall.displays[0]);
    EXPECT_FALSE(distance.from({199.5, 100}, {1, 0, 0.2}));
    EXPECT_FALSE(distance.from({100, 100}, {0, 0, 1}));
    EXPECT_FALSE(distance.from({0.5, 0.5}, {1, 0, 0.01}));  // a corner, which shows nothing
}

}  // namespace
}  // namespace curvewall
