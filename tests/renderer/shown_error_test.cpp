#include "renderer/shown_error.h"

#include "calibration/pieces/pixel_rays.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace curvewall
