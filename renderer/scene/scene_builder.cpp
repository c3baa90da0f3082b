#include "renderer/scene/scene_builder.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace curvewall {
namespace {

constexpr uint32_t kUnassigned = std::numeric_limits<uint32_t>::max();

template <class Vector>
bool isFinite(const Vector& v) {
    for (glm::length_t i = 0; i < v.length(); ++i)
        if (!std::isfinite(v[i])) return false;
    return true;
}

std::optional<glm::vec3> unitNormal(const glm::dvec3& normal) {
    // Scaled first, so that neither a tiny nor a huge vector is lost when it is squared.
    const double largest = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
    if (!std::isfinite(largest) || largest == 0 || !isFinite(normal)) return std::nullopt;
    return glm::vec3(glm::normalize(normal / largest));
}

// The centre of all that is drawn, in double, before anything is rounded.
glm::dvec3 centreOf(const std::vector<MeshPart>& parts) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-std::numeric_limits<double>::infinity());
    for (const MeshPart& part : parts) {
        for (const glm::uvec3& triangle : part.triangles) {
            for (glm::length_t corner = 0; corner < 3; ++corner) {
                const glm::dvec3& p = part.positionsM[triangle[corner]];
                if (!isFinite(p)) continue;
                low = glm::min(low, p);
                high = glm::max(high, p);
            }
        }
    }
    return low.x <= high.x ? 0.5 * low + 0.5 * high : glm::dvec3(0);
}

class GeometryWriter {
public:
    explicit GeometryWriter(Scene& scene) : scene_(scene) {}

    void add(const MeshPart& part) {
        indexOf_.assign(part.positionsM.size(), kUnassigned);
        for (const glm::uvec3& triangle : part.triangles) addTriangle(part, triangle);
    }

    size_t dropped() const { return dropped_; }

private:
    void addTriangle(const MeshPart& part, const glm::uvec3& triangle) {
        std::array<glm::vec3, 3> p;
        for (glm::length_t i = 0; i < 3; ++i)
            p[static_cast<size_t>(i)] = glm::vec3(part.positionsM[triangle[i]] - scene_.originM);
        const glm::dvec3 cross =
            glm::cross(glm::dvec3(p[1]) - glm::dvec3(p[0]), glm::dvec3(p[2]) - glm::dvec3(p[0]));
        const std::optional<glm::vec3> flat = unitNormal(cross);
        if (!isFinite(p[0]) || !isFinite(p[1]) || !isFinite(p[2]) || !flat) {
            ++dropped_;
            return;
        }
        glm::uvec3 written;
        for (glm::length_t i = 0; i < 3; ++i)
            written[i] = vertex(part, triangle[i], p[static_cast<size_t>(i)], *flat);
        scene_.triangles.push_back(written);
    }

    // Vertices are shared between triangles only where the file gives a normal to share.
    uint32_t vertex(const MeshPart& part, uint32_t index, const glm::vec3& position, const glm::vec3& flat) {
        if (!part.normals.empty() && indexOf_[index] != kUnassigned) return indexOf_[index];
        const auto written = static_cast<uint32_t>(scene_.positions.size());
        const bool hasUv = !part.uvs.empty() && isFinite(part.uvs[index]);
        scene_.positions.push_back(position);
        scene_.normals.push_back(part.normals.empty() ? flat
                                                      : unitNormal(part.normals[index]).value_or(flat));
        scene_.uvs.push_back(hasUv ? part.uvs[index] : glm::vec2(0));
        indexOf_[index] = written;
        return written;
    }

    Scene& scene_;
    std::vector<uint32_t> indexOf_;  // in the scene, of the part's vertices
    size_t dropped_ = 0;
};

}  // namespace

void setGeometry(Scene& scene, const std::vector<MeshPart>& parts) {
    scene.originM = centreOf(parts);

    std::vector<const MeshPart*> byMaterial;
    for (const MeshPart& part : parts) byMaterial.push_back(&part);
    std::stable_sort(byMaterial.begin(), byMaterial.end(),
                     [](const MeshPart* a, const MeshPart* b) { return a->material < b->material; });

    GeometryWriter writer(scene);
    for (const MeshPart* part : byMaterial) {
        const auto first = static_cast<uint32_t>(scene.triangles.size());
        writer.add(*part);
        const auto count = static_cast<uint32_t>(scene.triangles.size()) - first;
        if (count == 0) continue;
        if (!scene.ranges.empty() && scene.ranges.back().material == part->material)
            scene.ranges.back().triangleCount += count;
        else
            scene.ranges.push_back({part->material, first, count});
    }
    scene.droppedTriangles = writer.dropped();
    if (writer.dropped() > 0)
        scene.notes.push_back("dropped " + std::to_string(writer.dropped()) +
                              (writer.dropped() == 1 ? " triangle" : " triangles") +
                              " with non-finite positions or zero area");
}

}  // namespace curvewall
