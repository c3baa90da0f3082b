#pragma once
// The straightforward baseline of Lorenz and Doellner (2009), section 2: the whole scene once a piece.

#include "renderer/replicator.h"
#include "renderer/triangle_runs.h"

namespace curvewall {

class LoopReplicator : public Replicator {
public:
    explicit LoopReplicator(std::span<const SceneChunk> chunks) : chunks_(chunks) {}

    void draw(const PieceDraw& draw) override;
    FrameOutcome finishFrame() override;

private:
    std::span<const SceneChunk> chunks_;
    TriangleRuns range_;
    uint64_t pairCount_ = 0;
};

}  // namespace curvewall
