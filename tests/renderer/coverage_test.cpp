#include "renderer/coverage.h"

#include "calibration/pieces/piece_fit.h"
#include "renderer/frame_target.h"
#include "renderer/meshlets.h"
#include "renderer/node_grid.h"
#include "renderer/pair_replicator.h"
#include "renderer/piecewise.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/shipped_walls.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

namespace curvewall {
namespace {

class CoverageTest : public test::GlTest {
protected:
    struct Drawn {
        Frame frame;
        uint64_t pairs = 0;
        size_t parts = 0;
        int attempts = 0;
    };

    // Draws until every pair has room, as the renderer does.
    Drawn draw(uint32_t mostPairs) {
        const EglContext context;
        const Wall wall = test::fullCylinderWall({400, 300});
        const FittedPieces fitted = fitPieces(*wall.displays[0].projection, {400, 300}, 0.25);
        const GpuPieces pieces = uploadPieces(fitted.mesh);
        const GpuScene scene = uploadScene(std::make_shared<const Scene>(loadScene("city:20000")));
        auto replicator = std::make_unique<PairReplicator>(scene.chunks, mostPairs);
        const Coverage& coverage = replicator->coverage();
        SceneReplicators replicators{Engine::compute, std::move(replicator), nullptr};
        PiecewiseRenderer renderer(scene, pieces, &replicators, {});
        const FrameTarget target({400, 300}, {}, 1);
        Drawn drawn;
        for (FrameOutcome outcome{.overflowed = true}; outcome.overflowed; ++drawn.attempts) {
            target.begin({});
            renderer.record(sceneViewOf(scene.scene->defaultCamera, wall.eyeM, *scene.scene));
            glFinish();
            outcome = renderer.finishFrame();
            drawn.pairs = outcome.pairCount;
        }
        drawn.frame = target.read();
        drawn.parts = coverage.parts().size();
        return drawn;
    }
};

TEST_F(CoverageTest, AFrameInPartsIsTheSameFrame) {
    const Drawn whole = draw(~0u), parted = draw(3000);
    EXPECT_EQ(whole.parts, 1u);
    EXPECT_EQ(whole.attempts, 1);
    EXPECT_GT(parted.parts, 4u);
    EXPECT_GT(parted.attempts, 1);
    EXPECT_EQ(whole.pairs, parted.pairs);
    EXPECT_EQ(whole.frame.texels, parted.frame.texels);
}

class LookupTest : public test::GlTest, public testing::WithParamInterface<std::string> {
protected:
    void SetUp() override {
        GlTest::SetUp();
        if (!IsSkipped() && !HasFatalFailure()) context_.emplace();
    }

    SceneView viewAt(const GpuScene& scene, int turn) const {
        Camera camera = scene.scene->defaultCamera;
        camera.orientation.yawRad += turn;
        return sceneViewOf(camera, wall_.eyeM, *scene.scene);
    }

    template <class T>
    std::vector<T> contentsOf(const GlBuffer& buffer, size_t count) const {
        std::vector<T> contents(count);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        glGetNamedBufferSubData(buffer.id(), 0, static_cast<GLsizeiptr>(count * sizeof(T)), contents.data());
        return contents;
    }

    const Wall wall_ = test::shippedWall(GetParam());
    const PieceMesh mesh_ = fitPieces(wall_.displays[0], 1).mesh;
    std::optional<EglContext> context_;
};

TEST_P(LookupTest, TreeAndGridGiveTheSamePairs) {
    const GpuPieces pieces = uploadPieces(mesh_);
    const GpuScene scene = uploadScene(std::make_shared<const Scene>(loadScene("city:20000")));
    Coverage byTree(scene.chunks, ~0u, MeshletLookup::tree), byGrid(scene.chunks, ~0u, MeshletLookup::grid);
    for (int turn = 0; turn < 6; ++turn) {
        SCOPED_TRACE(turn);
        std::vector<std::vector<glm::uvec2>> pairs;
        for (Coverage* coverage : {&byTree, &byGrid}) {
            coverage->findPairs(0, pieces, viewAt(scene, turn), sampleGridOf(pieces, {}));
            glFinish();
            const FrameOutcome outcome = coverage->finishFrame();
            ASSERT_FALSE(outcome.overflowed);
            pairs.push_back(contentsOf<glm::uvec2>(coverage->pairs(), outcome.pairCount));
        }
        EXPECT_GT(pairs[0].size(), 1000u);
        EXPECT_TRUE(pairs[0] == pairs[1]) << pairs[0].size() << " and " << pairs[1].size();
    }
}

TEST_P(LookupTest, GridOnTheGpuHoldsWhatTheExactSphereHas) {
    const GpuPieces pieces = uploadPieces(mesh_);
    const NodeGrid grid = buildNodeGrid(mesh_, buildPieceTree(mesh_));
    const GpuScene scene = uploadScene(std::make_shared<const Scene>(loadScene("city:20000")));
    const SceneChunk& chunk = scene.chunks[0];
    Coverage coverage(scene.chunks);
    int seen = 0, same = 0;
    for (int turn = 0; turn < 6; ++turn) {
        const SceneView view = viewAt(scene, turn);
        coverage.findPairs(0, pieces, view, glm::vec4(0));
        const auto ranges = contentsOf<NodeRange>(coverage.meshletNodes(), chunk.meshletCount);
        for (size_t i = 0; i < ranges.size(); ++i) {
            const Meshlet& meshlet = chunk.meshletBounds[i];
            if (isBehind(meshlet, -view.originFromEyeM)) continue;
            const glm::dvec3 centre = glm::dmat3(view.wallFromScene) *
                                      (glm::dvec3(meshlet.centreM) + glm::dvec3(view.originFromEyeM));
            const NodeRange exact = nodesUnder(grid, centre, meshlet.radiusM);
            if (exact.x >= exact.y) continue;
            ++seen;
            same += ranges[i] == exact;
            ASSERT_LE(ranges[i].x, exact.x) << i;
            ASSERT_GE(ranges[i].y, exact.y) << i;
        }
    }
    EXPECT_GT(seen, 300);
    EXPECT_GT(same, seen * 9 / 10);
}

INSTANTIATE_TEST_SUITE_P(Displays, LookupTest,
                         testing::Values("camera-texture", "full-cylinder", "dome-master"));

}  // namespace
}  // namespace curvewall
