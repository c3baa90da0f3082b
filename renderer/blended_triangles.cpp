#include "renderer/blended_triangles.h"

#include "renderer/meshlets.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace curvewall {
namespace {

template <class T>
void replace(const GlBuffer& buffer, const std::vector<T>& values) {
    glNamedBufferSubData(buffer.id(), 0, static_cast<GLsizeiptr>(sizeof(T) * values.size()), values.data());
}

}  // namespace

BlendedTriangles::BlendedTriangles(SceneChunk chunk, std::vector<Triangle> triangles)
    : chunk_(std::move(chunk)), triangles_(std::move(triangles)) {
    const size_t count = triangles_.size();
    chunk_.triangleCount = static_cast<uint32_t>(count);
    chunk_.changes = true;
    chunk_.corners = makeBuffer(nullptr, sizeof(glm::uvec3) * count, GL_DYNAMIC_STORAGE_BIT);
    // Where no two neighbours share a material.
    chunk_.meshlets = makeBuffer(nullptr, sizeof(GpuMeshlet) * count, GL_DYNAMIC_STORAGE_BIT);
    chunk_.vertexArray = vertexArrayOver(chunk_);
    keys_.reserve(count);
    corners_.reserve(count);
    meshlets_.reserve(count);
    chunk_.ranges.reserve(count);
}

void BlendedTriangles::sortFor(const SceneView& view) {
    if (sortedFor_ == view.originFromEyeM) return;
    sortedFor_ = view.originFromEyeM;
    keys_.clear();
    for (uint32_t i = 0; i < triangles_.size(); ++i) {
        const glm::vec3 ray = triangles_[i].centre + view.originFromEyeM;
        keys_.push_back({glm::dot(ray, ray), i});
    }
    std::ranges::sort(keys_, [](const Key& a, const Key& b) {
        return a.squaredDistance != b.squaredDistance ? a.squaredDistance > b.squaredDistance
                                                      : a.triangle < b.triangle;
    });
    upload();
}

std::vector<glm::uvec3> BlendedTriangles::corners() const {
    std::vector<glm::uvec3> corners;
    for (const Triangle& triangle : triangles_) corners.push_back(triangle.corners);
    return corners;
}

void BlendedTriangles::setAcross(std::vector<uint32_t> across) {
    across_ = std::move(across);
    sortedAcross_.reserve(across_.size());
    chunk_.across = makeBuffer(nullptr, sizeof(uint32_t) * across_.size(), GL_DYNAMIC_STORAGE_BIT);
    sortedFor_.reset();
}

void BlendedTriangles::upload() {
    corners_.clear();
    meshlets_.clear();
    sortedAcross_.clear();
    chunk_.ranges.clear();
    for (const Key& key : keys_) {
        const Triangle& triangle = triangles_[key.triangle];
        const auto at = static_cast<uint32_t>(corners_.size());
        corners_.push_back(triangle.corners);
        if (!across_.empty()) {
            const auto edges = across_.begin() + static_cast<std::ptrdiff_t>(3 * size_t{key.triangle});
            sortedAcross_.insert(sortedAcross_.end(), edges, edges + 3);
        }
        if (chunk_.ranges.empty() || chunk_.ranges.back().material != triangle.material)
            chunk_.ranges.push_back({triangle.material, at, 0, static_cast<uint32_t>(meshlets_.size()), 0,
                                     triangle.isSingleSided});
        ChunkRange& range = chunk_.ranges.back();
        if (range.triangleCount % kMeshletTriangles == 0) {
            // What lies at one distance all around the eye is bounded by no sphere that would help.
            GpuMeshlet& meshlet = meshlets_.emplace_back();
            meshlet.sphere.w = std::numeric_limits<float>::max();
            meshlet.firstTriangle = at;
            meshlet.isSingleSided = triangle.isSingleSided ? 1 : 0;
            ++range.meshletCount;
        }
        ++meshlets_.back().triangleCount;
        ++range.triangleCount;
    }
    chunk_.meshletCount = static_cast<uint32_t>(meshlets_.size());
    replace(chunk_.corners, corners_);
    replace(chunk_.meshlets, meshlets_);
    if (!across_.empty()) replace(chunk_.across, sortedAcross_);
}

}  // namespace curvewall
