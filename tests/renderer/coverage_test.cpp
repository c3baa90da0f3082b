#include "renderer/coverage.h"

#include "calibration/pieces/piece_fit.h"
#include "renderer/frame_target.h"
#include "renderer/pair_replicator.h"
#include "renderer/piecewise.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/gl_fixture.h"
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

}  // namespace
}  // namespace curvewall
