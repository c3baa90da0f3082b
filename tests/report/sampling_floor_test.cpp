#include "report/sampling_floor.h"

#include "report/flat_scene.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/rendering.h"
#include "tests/support/small_walls.h"
#include "tests/support/test_scenes.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace curvewall {
namespace {

RenderRequest roomOnADome() {
    RenderRequest request =
        test::requestFor(test::smallShippedWall("dome-master", 8), boxRoom({8, 5, 8}), {{0.5, 0.3, 1}, {}});
    request.style = Style::unlit;
    return request;
}

double angleBetween(glm::dvec3 a, glm::dvec3 b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

TEST(FlatWindows, AreAsDenseAsTheDisplayInTheMiddle) {
    const RenderRequest view = roomOnADome();
    const Display& dome = findDisplay(*view.wall, "");
    // 180 degrees across, equidistant: the same everywhere along a radius.
    const double pixelRad = 3.14159265 / dome.sizePx.x;
    const auto windows = flatWindows(view);
    ASSERT_FALSE(windows.empty());
    const Display& window = windows[0].wall->displays[0];
    const glm::dvec2 middle = 0.5 * glm::dvec2(window.sizePx);
    const double seen = angleBetween(window.projection->unproject(middle - glm::dvec2(0.5, 0)).value(),
                                     window.projection->unproject(middle + glm::dvec2(0.5, 0)).value());
    EXPECT_NEAR(seen, pixelRad, 0.01 * pixelRad);
    const glm::dvec3 ahead = window.projection->unproject(middle).value();
    const glm::dvec3 wanted =
        dome.projection->unproject(0.5 * glm::dvec2(dome.sizePx) + glm::dvec2(0.5)).value();
    EXPECT_LT(angleBetween(ahead, wanted), pixelRad);
}

TEST(FlatWindows, AreNeverWiderThanFlatPicturesAreGoodFor) {
    RenderRequest tiny = roomOnADome();
    tiny.wall = std::make_shared<const Wall>(test::smallShippedWall("dome-master", 64));
    for (const RenderRequest& window : flatWindows(tiny)) {
        const Display& display = window.wall->displays[0];
        EXPECT_LT(angleBetween(display.projection->unproject({0, 0}).value(),
                               display.projection->unproject(display.sizePx).value()),
                  2.0);
    }
}

TEST(FlatWindows, ThereIsNoFloorWithoutThem) {
    Renderer renderer;
    EXPECT_FALSE(samplingFloor(renderer, {}, {}, roomOnADome().scene, 1).has_value());
}

class SamplingFloors : public test::GlTest {};

TEST_F(SamplingFloors, OfFlatColoursIsNothingAtOneSample) {
    const auto windows = flatWindows(roomOnADome());
    std::vector<KnownTruth> truths;
    for (const RenderRequest& window : windows) truths.push_back(traceTruth(window, {16, 1, 60}));
    const ScenePtr flat = flatScene(*windows[0].scene);
    Renderer renderer;
    const SamplingFloor one = samplingFloor(renderer, windows, truths, flat, 1).value();
    const SamplingFloor four = samplingFloor(renderer, windows, truths, flat, 4).value();
    EXPECT_LT(one.shareOff, 1e-4);
    EXPECT_EQ(one.edgesOff, one.shareOff);
    EXPECT_GT(four.supersampledPsnrDb, one.supersampledPsnrDb + 3);
}

}  // namespace
}  // namespace curvewall
