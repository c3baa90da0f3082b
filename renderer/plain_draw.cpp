#include "renderer/plain_draw.h"

#include "renderer/meshlets.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace curvewall {
PlainDraw::PlainDraw(const GpuPieces& pieces) {
    for (const auto& [x, y, w] : pieces.rows) {
        // Clip space is |x| <= w and |y| <= w, and each of these is a plane through the eye.
        Sides& sides = sides_.emplace_back(Sides{w + x, w - x, w + y, w - y});
        for (glm::vec3& side : sides) side = glm::normalize(side);
    }
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
    const bool isInside = std::ranges::any_of(sides_, [&](const Sides& sides) {
        return std::ranges::all_of(
            sides, [&](const glm::vec3& side) { return glm::dot(side, toCentre) >= -radius; });
    });
    return isInside && !(isSingleSided && isBehind(meshlet, -view.originFromEyeM));
}

void PlainDraw::add(uint32_t firstTriangle, uint32_t triangleCount) {
    runs_.add(firstTriangle, triangleCount);
    drawn_.pairCount += triangleCount;
}

void PlainDraw::draw(std::span<const SceneChunk> chunks, const PieceDraw& draw) {
    draw.timer.begin("surfaces");
    bindStorage(2, draw.pieces.pieces);
    const bool isLayered = sides_.size() > 1;
    if (isLayered) emitted_.begin();
    for (const SceneChunk& chunk : chunks) {
        draw.materials.bindVertices(chunk);
        for (const ChunkRange& range : chunk.ranges) {
            findRuns(chunk, range, draw.view);
            if (runs_.isEmpty()) continue;
            draw.materials.bind(range.material);
            runs_.draw(draw.materials.programs);
        }
    }
    if (isLayered) emitted_.end();
}

FrameOutcome PlainDraw::finishFrame() {
    if (sides_.size() > 1) {
        drawn_.pairCount = 0;
        for (const uint64_t count : emitted_.take()) drawn_.pairCount += count;
    }
    return drawn_;
}

}  // namespace curvewall
