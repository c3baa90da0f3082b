// Hardly more pairs of a triangle and a piece are drawn than there have to be.

#include "renderer/scene/load_scene.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/replication_ratio.h"
#include "tests/support/sample_paths.h"
#include "tests/support/shipped_walls.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

namespace curvewall {
namespace {

constexpr double kMostRatio = 1.15;
constexpr int kTurns = 3;

struct FittedWall {
    std::string name;
    double tolerancePx;
};

class Replication : public test::GlTest {
protected:
    // Without samples to lie between (samples = 4) the ratio is that of coverage alone.
    static void expectFewPairs(const std::string& sceneName, const std::vector<FittedWall>& walls) {
        const auto scene = std::make_shared<const Scene>(loadScene(sceneName));
        Renderer renderer;
        for (const auto& [name, tolerancePx] : walls) {
            RenderRequest request;
            request.wall = std::make_shared<const Wall>(test::shippedWall(name));
            request.pieces =
                std::make_shared<const FittedPieces>(fitPieces(request.wall->displays[0], tolerancePx));
            request.tolerancePx = tolerancePx;
            request.scene = scene;
            request.camera = scene->defaultCamera;
            request.style = Style::unlit;
            for (const int samples : {1, 4}) {
                request.samples = samples;
                const test::Replication found = test::replicationOf(renderer, request, kTurns);
                const std::string of = name + ", samples " + std::to_string(samples);
                EXPECT_GT(found.exact, 0) << of;
                EXPECT_LE(found.worstRatio, kMostRatio) << of;
                if (samples > 1) {
                    EXPECT_GE(found.ratio(), 1) << of;
                }
            }
        }
    }

    static void expectFewPairsOfSample(const std::string& file) {
        const std::filesystem::path path = test::scenesFolder() / file;
        if (!std::filesystem::exists(path))
            GTEST_SKIP() << path << " is not here; set CURVEWALL_SAMPLES to the samples folder";
        expectFewPairs(path.string(), kWalls);
    }

    inline static const std::vector<FittedWall> kWalls{
        {"full-cylinder", 0.25}, {"dome-master", 0.5}, {"camera-texture", 0.5}};
};

TEST_F(Replication, OfTheCityIsNearTheSmallest) { expectFewPairs("city", kWalls); }

TEST_F(Replication, OfARoomIsNearTheSmallest) { expectFewPairs("room", kWalls); }

TEST_F(Replication, OfAShipIsNearTheSmallest) {
    expectFewPairsOfSample("dutch_ship/dutch_ship_medium_1k.gltf");
}

TEST_F(Replication, OfAGalleryIsNearTheSmallest) { expectFewPairsOfSample("vr_gallery/vr_gallery.glb"); }

}  // namespace
}  // namespace curvewall
