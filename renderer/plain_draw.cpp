#include "renderer/plain_draw.h"

#include "renderer/meshlets.h"

#include <glm/geometric.hpp>

#include <utility>

namespace curvewall {
namespace {

const void* bytesFor(uint32_t triangles) {
    return reinterpret_cast<const void*>(sizeof(glm::uvec3) * triangles);
}

}  // namespace

PlainDraw::PlainDraw(const GpuPieces& pieces) {
    // Clip space is |x| <= w and |y| <= w, and each of these is a plane through the eye.
    const auto& [x, y, w] = pieces.firstRows;
    sides_ = {w + x, w - x, w + y, w - y};
    for (glm::vec3& side : sides_) side = glm::normalize(side);
}

void PlainDraw::findRuns(const SceneChunk& chunk, const ChunkRange& range, const SceneView& view) {
    indexCounts_.clear();
    firstIndices_.clear();
    if (chunk.changes) {
        addRun(range.firstTriangle, range.triangleCount);
        return;
    }
    uint32_t end = ~0u;  // of the last run
    for (uint32_t i = range.firstMeshlet; i < range.firstMeshlet + range.meshletCount; ++i) {
        const Meshlet& meshlet = chunk.meshletBounds[i];
        if (!isSeen(meshlet, range.isSingleSided, view)) continue;
        if (meshlet.firstTriangle == end) {
            indexCounts_.back() += static_cast<GLsizei>(3 * meshlet.triangleCount);
            triangleCount_ += meshlet.triangleCount;
        } else {
            addRun(meshlet.firstTriangle, meshlet.triangleCount);
        }
        end = meshlet.firstTriangle + meshlet.triangleCount;
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

void PlainDraw::addRun(uint32_t firstTriangle, uint32_t triangleCount) {
    indexCounts_.push_back(static_cast<GLsizei>(3 * triangleCount));
    firstIndices_.push_back(bytesFor(firstTriangle));
    triangleCount_ += triangleCount;
}

void PlainDraw::draw(std::span<const SceneChunk> chunks, const PieceDraw& draw) {
    bindStorage(2, draw.pieces.pieces);
    for (const SceneChunk& chunk : chunks) {
        glBindVertexArray(chunk.vertexArray.id());
        for (const ChunkRange& range : chunk.ranges) {
            findRuns(chunk, range, draw.view);
            if (indexCounts_.empty()) continue;
            draw.materials.bind(range.material);
            glMultiDrawElements(GL_TRIANGLES, indexCounts_.data(), GL_UNSIGNED_INT, firstIndices_.data(),
                                static_cast<GLsizei>(indexCounts_.size()));
        }
    }
}

uint64_t PlainDraw::takeTriangleCount() { return std::exchange(triangleCount_, 0); }

}  // namespace curvewall
