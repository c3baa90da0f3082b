// Watertight with single cover: from inside a closed convex room each ray meets one wall, so that no pixel
// may be left and none drawn twice, on any display. CURVEWALL_ROOM_EYES=1000 looks from as many eyes (minutes
// a wall).

#include "calibration/pieces/piece_fit.h"
#include "renderer/render.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/random_numbers.h"
#include "tests/support/rendering.h"
#include "tests/support/shipped_walls.h"
#include "tests/support/test_scenes.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>

namespace curvewall {
namespace {

constexpr double kPi = std::numbers::pi;

int eyesAWall() {
    const char* const asked = std::getenv("CURVEWALL_ROOM_EYES");
    return asked ? std::atoi(asked) : 10;
}

// The eye somewhere in the room, half a metre or more from its walls, and the wall turned in any way.
Camera cameraInRoom(test::Random& random, glm::dvec3 eyeInWallM) {
    Camera camera;
    camera.orientation = {random.uniform(-kPi, kPi), random.uniform(-kPi / 2, kPi / 2),
                          random.uniform(-kPi, kPi)};
    const glm::dvec3 eyeM(random.uniform(-3.5, 3.5), random.uniform(-2, 2), random.uniform(-3.5, 3.5));
    camera.positionM = eyeM - rotationFromOrientation(camera.orientation) * eyeInWallM;
    return camera;
}

// At the poles of the panorama a pixel is 1e-6 rad wide, and some cells of one column get facets so steep
// that single precision cannot cut them (docs/pieces.md). They are known, and everything else has to be
// covered.
size_t mostUncovered(const std::string& wall) { return wall == "equirectangular" ? 32 : 0; }

class EveryShippedWall : public test::GlTest, public testing::WithParamInterface<std::string> {};

TEST_P(EveryShippedWall, CoversAClosedRoomOnce) {
    Renderer renderer;
    RenderRequest request;
    request.wall = std::make_shared<const Wall>(test::shippedWall(GetParam()));
    request.scene = std::make_shared<const Scene>(loadScene("room"));
    request.output = OutputKind::coverage;
    request.tolerancePx = 0.5;
    for (const Display& display : request.wall->displays) {
        request.display = display.name;
        const FittedPieces fitted = fitPieces(display, request.tolerancePx);
        request.pieces = std::make_shared<const FittedPieces>(fitted);
        test::Random random(5);
        for (int i = 0; i < eyesAWall(); ++i) {
            request.camera = cameraInRoom(random, request.wall->eyeM);
            const Frame coverage = renderer.render(request).frame;
            size_t uncovered = 0, twice = 0;
            for (size_t pixel = 0; pixel < coverage.texels.size(); ++pixel) {
                const float expected = (*fitted.owners)[pixel] >= 0 ? 1.0f : 0.0f;
                uncovered += coverage.texels[pixel] < expected;
                twice += coverage.texels[pixel] > expected;
            }
            ASSERT_LE(uncovered, mostUncovered(GetParam())) << display.name << ", eye " << i;
            ASSERT_EQ(twice, 0u) << display.name << ", eye " << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(SingleCover, EveryShippedWall, testing::ValuesIn(test::shippedWallNames()),
                         [](const auto& wall) {
                             std::string name = wall.param;
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

// A room of glass: a quarter of the light from each surface, so that a sample that two pieces draw is too
// bright and one that none draws too dark. The average over the samples of a pixel shows either.
class GlassRoom : public test::GlTest, public testing::WithParamInterface<Blending> {
protected:
    static Scene room(Blending blending) {
        Scene scene = boxRoom({8, 5, 8});
        for (Material& material : scene.materials) {
            material.baseColor = {1, 1, 1, 0.25};
            material.blending = blending;
            material.unlit = true;
        }
        return scene;
    }
};

TEST_P(GlassRoom, EverySampleIsDrawnOnce) {
    Renderer renderer;
    test::Random random(6);
    const Wall walls[] = {test::fullCylinderWall({320, 240}), test::shippedWall("view-deformation"),
                          test::shippedWall("dome-master")};
    for (const Wall& wall : walls) {
        RenderRequest request = test::requestFor(wall, room(GetParam()));
        request.linearOutput = true;
        const_cast<Wall&>(*request.wall).background = glm::vec3(0);
        const FittedPieces fitted = fitPieces(wall.displays[0], request.tolerancePx);
        request.pieces = std::make_shared<const FittedPieces>(fitted);
        for (const int samples : {1, 2, 4, 7}) {
            request.samples = samples;
            request.camera = cameraInRoom(random, wall.eyeM);
            const Frame frame = renderer.render(request).frame;
            size_t wrong = 0;
            for (size_t pixel = 0; pixel < fitted.owners->size(); ++pixel)
                wrong += (*fitted.owners)[pixel] >= 0 && std::abs(frame.texels[3 * pixel] - 0.25f) > 1e-3f;
            // At the border of the display samples of a pixel that it has may lie outside.
            const size_t border = samples == 1 ? 0 : 4 * static_cast<size_t>(frame.sizePx.x + frame.sizePx.y);
            const bool endsWithin = wall.displays[0].name == "dome";
            EXPECT_LE(wrong, endsWithin ? border : 0) << wall.name << ", " << samples << " samples";
        }
    }
}

INSTANTIATE_TEST_SUITE_P(SingleCover, GlassRoom, testing::Values(Blending::alpha, Blending::additive),
                         [](const auto& blending) {
                             return blending.param == Blending::alpha ? "Alpha" : "Additive";
                         });

}  // namespace
}  // namespace curvewall
