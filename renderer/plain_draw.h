#pragma once
// Draws a scene as one plain perspective picture, or as several at once, without what lies outside of them.

#include "renderer/primitive_queries.h"
#include "renderer/replicator.h"
#include "renderer/visible_runs.h"

namespace curvewall {

class PlainDraw {
public:
    // For a piece mesh of one piece, or for faces that a geometry shader sends each triangle to.
    explicit PlainDraw(const GpuPieces& pieces);

    // Leaves out the meshlets that lie beside every picture or are seen from behind.
    void draw(std::span<const SceneChunk> chunks, const PieceDraw& draw);

    void beginPass() { runs_.beginPass(); }

    // Triangles, of all pictures, and meshlets drawn in the last pass. Call it after the GPU has finished.
    FrameOutcome finishFrame();

private:
    bool isLayered_;
    VisibleRuns runs_;
    PrimitiveQueries emitted_;  // by the geometry shader, where there are several pictures
};

}  // namespace curvewall
