#pragma once
// Draws a scene as one plain perspective picture, without what lies outside it.

#include "renderer/replicator.h"
#include "renderer/visible_runs.h"

namespace curvewall {

class PlainDraw {
public:
    // For a piece mesh of one piece.
    explicit PlainDraw(const GpuPieces& pieces);

    void draw(std::span<const SceneChunk> chunks, const PieceDraw& draw);

    void beginPass() { runs_.beginPass(); }

    // Triangles and meshlets drawn in the last pass.
    const FrameOutcome& finishFrame() const { return runs_.found(); }

private:
    VisibleRuns runs_;
};

}  // namespace curvewall
