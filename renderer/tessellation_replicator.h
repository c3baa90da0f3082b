#pragma once
// Lorenz and Doellner (2009), section 2.2, in one pass: a triangle is a patch that the tessellator makes a
// point a piece of, which the geometry shader draws there. Nothing is kept, nothing can overflow.

#include "renderer/primitive_queries.h"
#include "renderer/replicator.h"

namespace curvewall {

class TessellationReplicator : public Replicator {
public:
    explicit TessellationReplicator(std::span<const SceneChunk> chunks);

    void draw(const PieceDraw& draw) override;
    FrameOutcome finishFrame() override;

private:
    std::span<const SceneChunk> chunks_;
    PrimitiveQueries pairQueries_;
    GlVertexArray emptyVertexArray_;
};

}  // namespace curvewall
