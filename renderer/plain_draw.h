#pragma once
// Draws a scene as one plain perspective picture, without what lies outside it.

#include "renderer/replicator.h"
#include "renderer/triangle_runs.h"

#include <array>

namespace curvewall {

class PlainDraw {
public:
    // For a piece mesh of one piece.
    explicit PlainDraw(const GpuPieces& pieces);

    // Leaves out the meshlets that lie beside the picture or are seen from behind.
    void draw(std::span<const SceneChunk> chunks, const PieceDraw& draw);

    void beginPass() { drawn_ = {}; }

    // Triangles and meshlets drawn in the last pass.
    const FrameOutcome& finishFrame() const { return drawn_; }

private:
    bool isSeen(const Meshlet& meshlet, bool isSingleSided, const SceneView& view) const;
    void add(uint32_t firstTriangle, uint32_t triangleCount);
    void findRuns(const SceneChunk& chunk, const ChunkRange& range, const SceneView& view);

    std::array<glm::vec3, 4> sides_;  // planes through the eye, length one, and the sides of the picture
    TriangleRuns runs_;
    FrameOutcome drawn_;
};

}  // namespace curvewall
