#pragma once
// Draws the pairs that compute shaders have found.

#include "renderer/coverage.h"
#include "renderer/replicator.h"

namespace curvewall {

class PairReplicator : public Replicator {
public:
    // `mostPairs` limits the pairs of a part below what the driver allows.
    explicit PairReplicator(std::span<const SceneChunk> chunks, uint32_t mostPairs = ~0u,
                            MeshletLookup lookup = MeshletLookup::grid);

    void draw(const PieceDraw& draw) override;
    FrameOutcome finishFrame() override { return coverage_.finishFrame(); }

    size_t memoryBytes() const override { return coverage_.memoryBytes(); }

    const Coverage& coverage() const { return coverage_; }

private:
    Coverage coverage_;
    GlVertexArray emptyVertexArray_;
};

}  // namespace curvewall
