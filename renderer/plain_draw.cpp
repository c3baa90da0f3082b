#include "renderer/plain_draw.h"

#include "renderer/meshlets.h"

#include <glm/geometric.hpp>

namespace curvewall {
PlainDraw::PlainDraw(const GpuPieces& pieces) {
    // Clip space is |x| <= w and |y| <= w, and each of these is a plane through the eye.
    const auto& [x, y, w] = pieces.firstRows;
    sides_ = {w + x, w - x, w + y, w - y};
    for (glm::vec3& side : sides_) side = glm::normalize(side);
}

void PlainDraw::findRuns(const SceneChunk& chunk, const ChunkRange& range, const SceneView& view) {
    runs_.clear();
    if (chunk.changes) {
        add(range.firstTriangle, range.triangleCount);
        return;
    }
    for (uint32_t i = range.firstMeshlet; i < range.firstMeshlet + range.meshletCount; ++i) {
        const Meshlet& meshlet = chunk.meshletBounds[i];
        if (!isSeen(meshlet, range.isSingleSided, view)) continue;
        add(meshlet.firstTriangle, meshlet.triangleCount);
        ++drawn_.meshletCount;
    }
}

bool PlainDraw::isSeen(const Meshlet& meshlet, bool isSingleSided, const SceneView& view) const {
    const glm::vec3 toCentre = view.wallFromScene * (meshlet.centreM + view.originFromEyeM);
    // What the subtraction of the eye rounds off is a share of the distance.
    const float radius = meshlet.radiusM + 1e-6f * glm::length(toCentre);
    for (const glm::vec3& side : sides_)
        if (glm::dot(side, toCentre) < -radius) return false;
    return !(isSingleSided && isBehind(meshlet, -view.originFromEyeM));
}

void PlainDraw::add(uint32_t firstTriangle, uint32_t triangleCount) {
    runs_.add(firstTriangle, triangleCount);
    drawn_.pairCount += triangleCount;
}

void PlainDraw::draw(std::span<const SceneChunk> chunks, const PieceDraw& draw) {
    draw.timer.begin("surfaces");
    bindStorage(2, draw.pieces.pieces);
    for (const SceneChunk& chunk : chunks) {
        draw.materials.bindVertices(chunk);
        for (const ChunkRange& range : chunk.ranges) {
            findRuns(chunk, range, draw.view);
            if (runs_.isEmpty()) continue;
            draw.materials.bind(range.material);
            runs_.draw(draw.materials.programs);
        }
    }
}

}  // namespace curvewall
