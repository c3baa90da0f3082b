#include "renderer/image_based.h"

#include "calibration/errors.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/rendering.h"
#include "tests/support/test_scenes.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

class ImageBased : public test::GlTest {
protected:
    RenderRequest request(Wall wall, Scene scene, int faceSizePx) {
        RenderRequest made = test::requestFor(std::move(wall), std::move(scene), {{0, 8, 0}, {0.3, 0, 0}});
        made.method = Method::imageBased;
        made.faceSizePx = faceSizePx;
        return made;
    }
};

TEST_F(ImageBased, ComesNearerToTheReferenceWithLargerFaces) {
    // Flat colours, so that only the edges tell: their error is the blur of a texel.
    RenderRequest room = request(test::fullCylinderWall({400, 300}), boxRoom({8, 5, 8}), 0);
    room.camera = {{0.5, 0.3, 1}, {0.7, 0.2, 0.1}};
    room.style = Style::unlit;
    double worse = 1;
    for (int faceSizePx : {64, 256, 1024, 4096}) {
        room.faceSizePx = faceSizePx;
        const double shareOff = test::differenceFromReference(room).shareOff;
        EXPECT_LT(shareOff, worse);
        worse = shareOff;
    }
    EXPECT_LT(worse, 0.002);
}

TEST_F(ImageBased, CityAgreesWithTheReferenceAsFarAsResamplingGoes) {
    // Two texels a pixel. Every edge and every texel is filtered twice, which the piecewise picture is not.
    const RenderRequest city = request(test::fullCylinderWall({800, 600}), loadScene("city"), 1024);
    const ImageDifference difference = test::differenceFromReference(city);
    EXPECT_LT(difference.shareOff, 0.2);
    EXPECT_GT(difference.psnrDb, 24);
}

TEST_F(ImageBased, DrawsOnlyTheFacesThatTheDisplaySees) {
    Renderer renderer;
    EXPECT_EQ(renderer.render(request(test::planarWall({400, 300}, 80), loadScene("room"), 64)).stats.faces,
              1);
    EXPECT_EQ(renderer
                  .render(request(test::cylinderWall({2, test::kPi, 1, {}, {}}, {}, {400, 100}),
                                  loadScene("room"), 64))
                  .stats.faces,
              3);
    EXPECT_EQ(renderer.render(request(test::fullCylinderWall({400, 300}), loadScene("room"), 64)).stats.faces,
              6);
}

TEST_F(ImageBased, StatedErrorIsThatOfThePointsItShows) {
    // For every pixel, the closed-form pixel of the position shown: the largest is what the stats say.
    RenderRequest city = request(test::fullCylinderWall({400, 300}), loadScene("room"), 256);
    city.camera = {};
    city.output = OutputKind::position;
    const RenderResult result = Renderer().render(city);
    const double height = 4 * test::kPi * 300 / 400;
    double largest = 0;
    for (int y = 0; y < 300; ++y) {
        for (int x = 0; x < 400; ++x) {
            const float* p = result.frame.at(x, y);
            ASSERT_TRUE(std::isfinite(p[0]));
            const double px = 400 * (0.5 + std::atan2(p[0], -p[2]) / (2 * test::kPi));
            const double py = 300 * (0.5 - 2 * p[1] / std::hypot(p[0], p[2]) / height);
            double dx = std::abs(px - x - 0.5);
            dx = std::min(dx, 400 - dx);
            largest = std::max(largest, std::hypot(dx, py - y - 0.5));
        }
    }
    EXPECT_NEAR(largest, result.stats.geometricError.maxPx, 0.01);
}

TEST_F(ImageBased, FaceSizeFollowsThePeakPixelDensity) {
    // A planar display of the width of one face: one texel for one pixel, to the next 16.
    RenderRequest planar = request(test::planarWall({400, 400}, 90), loadScene("room"), 0);
    EXPECT_EQ(Renderer().render(planar).stats.faceSizePx, 400);
}

TEST_F(ImageBased, RefusesMultisampling) {
    RenderRequest city = request(test::planarWall({40, 40}, 90), loadScene("room"), 64);
    city.samples = 4;
    EXPECT_THROW(Renderer().render(city), UsageError);
}

}  // namespace
}  // namespace curvewall
