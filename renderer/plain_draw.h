#pragma once
// Draws a scene as one plain perspective picture, or as several at once, without what lies outside of them.

#include "renderer/primitive_queries.h"
#include "renderer/replicator.h"
#include "renderer/triangle_runs.h"

#include <array>
#include <vector>

namespace curvewall {

class PlainDraw {
public:
    // For a piece mesh of one piece, or for faces that a geometry shader sends each triangle to.
    explicit PlainDraw(const GpuPieces& pieces);

    // Leaves out the meshlets that lie beside every picture or are seen from behind.
    void draw(std::span<const SceneChunk> chunks, const PieceDraw& draw);

    void beginPass() { drawn_ = {}; }

    // Triangles, of all pictures, and meshlets drawn in the last pass. Call it after the GPU has finished.
    FrameOutcome finishFrame();

private:
    // Planes through the eye, length one, and the sides of a picture.
    using Sides = std::array<glm::vec3, 4>;
    bool isSeen(const Meshlet& meshlet, bool isSingleSided, const SceneView& view) const;
    void add(uint32_t firstTriangle, uint32_t triangleCount);
    void findRuns(const SceneChunk& chunk, const ChunkRange& range, const SceneView& view);

    std::vector<Sides> sides_;  // of each picture
    TriangleRuns runs_;
    PrimitiveQueries emitted_;  // by the geometry shader, where there are several pictures
    FrameOutcome drawn_;
};

}  // namespace curvewall
