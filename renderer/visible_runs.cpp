#include "renderer/visible_runs.h"

#include "renderer/meshlets.h"

#include <glm/geometric.hpp>

namespace curvewall {

const TriangleRuns& VisibleRuns::find(const SceneChunk& chunk, const ChunkRange& range,
                                      const SceneView& view) {
    runs_.clear();
    if (chunk.changes) {
        add(range.firstTriangle, range.triangleCount);
        return runs_;
    }
    for (uint32_t i = range.firstMeshlet; i < range.firstMeshlet + range.meshletCount; ++i) {
        const Meshlet& meshlet = chunk.meshletBounds[i];
        if (!isSeen(meshlet, range.isSingleSided, view)) continue;
        add(meshlet.firstTriangle, meshlet.triangleCount);
        ++found_.meshletCount;
    }
    return runs_;
}

bool VisibleRuns::isSeen(const Meshlet& meshlet, bool isSingleSided, const SceneView& view) const {
    const glm::vec3 toCentre = view.wallFromScene * (meshlet.centreM + view.originFromEyeM);
    // What the subtraction of the eye rounds off is a share of the distance.
    const float radius = meshlet.radiusM + 1e-6f * glm::length(toCentre);
    return reachesIn_(toCentre, radius) && !(isSingleSided && isBehind(meshlet, -view.originFromEyeM));
}

void VisibleRuns::add(uint32_t firstTriangle, uint32_t triangleCount) {
    runs_.add(firstTriangle, triangleCount);
    found_.pairCount += triangleCount;
}

}  // namespace curvewall
