// A frame fetches and draws what the picture needs, and the statistics say so.

#include "renderer/render.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/rendering.h"
#include "tests/support/test_walls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace curvewall {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Not;

constexpr glm::ivec2 kSizePx(320, 240);

class OnlyWhatIsNeeded : public test::GlTest {
protected:
    RenderStats statsOf(const RenderRequest& request) { return renderer_.render(request).stats; }

    static RenderRequest cityOn(Wall wall) {
        RenderRequest request = test::requestFor(std::move(wall), loadScene("city"));
        request.camera = request.scene->defaultCamera;
        return request;
    }

    static Wall quarterCylinder() {
        return test::cylinderWall({2, std::numbers::pi / 2, 2, {}, {}}, {}, kSizePx);
    }

    Renderer renderer_;
};

TEST_F(OnlyWhatIsNeeded, DepthReadsNoTexture) {
    RenderRequest request = cityOn(test::fullCylinderWall(kSizePx));
    for (const OutputKind output : {OutputKind::depth, OutputKind::coverage, OutputKind::position}) {
        request.output = output;
        EXPECT_THAT(statsOf(request).attributes, ElementsAre("position"));
    }
}

TEST_F(OnlyWhatIsNeeded, UnlitReadsNoNormals) {
    RenderRequest request = cityOn(test::fullCylinderWall(kSizePx));
    EXPECT_THAT(statsOf(request).attributes, Contains("normal"));
    request.style = Style::unlit;
    EXPECT_THAT(statsOf(request).attributes, Not(Contains("normal")));
    EXPECT_THAT(statsOf(request).attributes, Contains("texture"));
}

TEST_F(OnlyWhatIsNeeded, EdgesAreForStylesThatDrawThem) {
    RenderRequest request = cityOn(test::fullCylinderWall(kSizePx));
    EXPECT_THAT(statsOf(request).attributes, Not(Contains("edges")));
    request.style = Style::wireframe;
    EXPECT_THAT(statsOf(request).attributes, Contains("edges"));
}

TEST_F(OnlyWhatIsNeeded, ASceneWithoutTexturesHasNoUvs) {
    const RenderRequest request = test::requestFor(test::fullCylinderWall(kSizePx), loadScene("room"));
    Scene bare = *request.scene;
    bare.textures.clear();
    for (Material& material : bare.materials) material.texture = -1;
    EXPECT_THAT(statsOf(test::requestFor(test::fullCylinderWall(kSizePx), bare)).attributes,
                ElementsAre("position", "normal"));
}

TEST_F(OnlyWhatIsNeeded, ANinetyDegreeWallDrawsOneFace) {
    RenderRequest request = cityOn(test::planarWall(kSizePx, 89));
    request.method = Method::imageBased;
    EXPECT_EQ(statsOf(request).faces, 1);
    request.method = Method::piecewise;
    EXPECT_EQ(statsOf(request).pieces, 1);
    EXPECT_EQ(statsOf(request).engine, "plain");
}

TEST_F(OnlyWhatIsNeeded, AViewIntoEmptySpaceCostsNextToNothing) {
    for (const Wall& wall : {test::planarWall(kSizePx, 90), quarterCylinder()}) {
        RenderRequest request = cityOn(wall);
        request.camera.positionM = {0, 5000, 0};
        request.camera.orientation.pitchRad = std::numbers::pi / 2;
        for (const Method method : {Method::piecewise, Method::imageBased}) {
            request.method = method;
            const RenderStats stats = statsOf(request);
            EXPECT_GT(stats.meshlets, 400u);
            EXPECT_EQ(stats.meshletsDrawn, 0u);
            EXPECT_EQ(stats.pairs, 0u);
        }
    }
}

TEST_F(OnlyWhatIsNeeded, ACameraThatSeesLittleLooksIntoFewMeshlets) {
    RenderRequest request = cityOn(quarterCylinder());
    const RenderStats ahead = statsOf(request);
    request.wall = std::make_shared<const Wall>(test::fullCylinderWall(kSizePx));
    const RenderStats around = statsOf(request);
    EXPECT_LT(2 * ahead.meshletsDrawn, around.meshletsDrawn);
    EXPECT_LT(2 * ahead.pairs, around.pairs);
}

TEST_F(OnlyWhatIsNeeded, MemoryIsThatOfTheBuffers) {
    const RenderStats stats = statsOf(cityOn(test::fullCylinderWall(kSizePx)));
    // 35,000 triangles of three corners, 4 bytes each, are 0.4 MiB; the textures are some MiB.
    EXPECT_GT(stats.gpuMemoryMib.scene, 0.4);
    EXPECT_LT(stats.gpuMemoryMib.scene, 100);
    // At least its pairs, 8 bytes each.
    EXPECT_GT(stats.gpuMemoryMib.pairs * 1024 * 1024, 8.0 * static_cast<double>(stats.pairs));
}

TEST_F(OnlyWhatIsNeeded, MemoryIsThatOfThePicturesAndTheDisplay) {
    const double megapixels = kSizePx.x * kSizePx.y / (1024.0 * 1024.0);
    RenderRequest request = cityOn(test::fullCylinderWall(kSizePx));
    const GpuMemoryMib piecewise = statsOf(request).gpuMemoryMib;
    // A colour and a depth of 4 bytes each; an owner of 4 bytes beside the pieces.
    EXPECT_DOUBLE_EQ(piecewise.pictures, 8 * megapixels);
    EXPECT_GT(piecewise.display, 4 * megapixels);

    request.method = Method::imageBased;
    request.faceSizePx = 256;
    const RenderStats imageBased = statsOf(request);
    const double megatexels = static_cast<double>(imageBased.sourceTexels) / (1024 * 1024);
    // And the faces, with one depth for all of them; where each pixel looks, 16 bytes.
    const double expectedMib = 8 * megapixels + 4 * megatexels * (1 + 1.0 / imageBased.faces);
    EXPECT_GE(imageBased.gpuMemoryMib.pictures, expectedMib);
    EXPECT_LT(imageBased.gpuMemoryMib.pictures, 1.1 * expectedMib);
    EXPECT_GT(imageBased.gpuMemoryMib.display, 16 * megapixels);

    request.samples = 4;
    EXPECT_GT(statsOf(request).gpuMemoryMib.pictures, imageBased.gpuMemoryMib.pictures);
}

TEST_F(OnlyWhatIsNeeded, StagesAddUpToLessThanTheFrames) {
    RenderRequest request = cityOn(test::fullCylinderWall(kSizePx));
    EXPECT_TRUE(statsOf(request).stageMs.empty());
    request.timesStages = true;
    const RenderStats stats = statsOf(request);
    double sumMs = 0;
    std::vector<std::string> names;
    for (const auto& [stage, ms] : stats.stageMs) {
        EXPECT_GE(ms, 0) << stage;
        names.push_back(stage);
        sumMs += ms;
    }
    EXPECT_THAT(names, ElementsAre("meshlets", "surfaces", "triangles"));
    EXPECT_LE(sumMs, stats.frameMsMax + 1);
}

}  // namespace
}  // namespace curvewall
