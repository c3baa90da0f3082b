#include "renderer/scene/scene_builder.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>

namespace curvewall {
namespace {

constexpr uint32_t kUnassigned = std::numeric_limits<uint32_t>::max();
constexpr glm::vec3 kUnread(0, 1, 0);  // the normal of what is unlit

template <class Vector>
bool isFinite(const Vector& v) {
    for (glm::length_t i = 0; i < v.length(); ++i)
        if (!std::isfinite(v[i])) return false;
    return true;
}

template <class Vector>
bool isWithinReach(const Vector& v) {
    for (glm::length_t i = 0; i < v.length(); ++i)
        if (!(std::abs(v[i]) <= kFarthestVertexM)) return false;
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
    const auto include = [&](const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    };
    for (const MeshPart& part : parts) {
        for (const glm::uvec3& triangle : part.triangles) {
            const glm::dvec3& a = part.positionsM[triangle.x];
            const glm::dvec3& b = part.positionsM[triangle.y];
            const glm::dvec3& c = part.positionsM[triangle.z];
            if (!unitNormal(glm::cross(b - a, c - a)) || !isWithinReach(b - a) || !isWithinReach(c - a))
                continue;
            for (const glm::dvec3& p : {a, b, c}) include(p);
        }
        for (const uint32_t point : part.points)
            if (isFinite(part.positionsM[point])) include(part.positionsM[point]);
        for (const glm::uvec2& line : part.lines)
            if (isFinite(part.positionsM[line.x]) && isFinite(part.positionsM[line.y]))
                for (const uint32_t end : {line.x, line.y}) include(part.positionsM[end]);
    }
    return low.x <= high.x ? 0.5 * low + 0.5 * high : glm::dvec3(0);
}

class GeometryWriter {
public:
    explicit GeometryWriter(Scene& scene) : scene_(scene) {}

    void add(const MeshPart& part) {
        indexOf_.assign(part.positionsM.size(), kUnassigned);
        // In a pass of its own: where g++ 12 at -O3 sees a double become float and double again, it skips the
        // rounding, and a triangle without area would seem to have one.
        rounded_.clear();
        for (const glm::dvec3& p : part.positionsM) rounded_.emplace_back(p - scene_.originM);
        for (const glm::uvec3& triangle : part.triangles) addTriangle(part, triangle);
        for (const uint32_t point : part.points) addPoint(part, point);
        for (const glm::uvec2& line : part.lines) addLine(part, line);
    }

    size_t dropped() const { return dropped_; }
    size_t droppedStrokes() const { return droppedStrokes_; }

private:
    void addTriangle(const MeshPart& part, const glm::uvec3& triangle) {
        const glm::vec3 a = rounded_[triangle.x], b = rounded_[triangle.y], c = rounded_[triangle.z];
        const glm::dvec3 corner(a);
        const std::optional<glm::vec3> flat =
            unitNormal(glm::cross(glm::dvec3(b) - corner, glm::dvec3(c) - corner));
        if (!isWithinReach(a) || !isWithinReach(b) || !isWithinReach(c) || !flat) {
            ++dropped_;
            return;
        }
        glm::uvec3 written;
        for (glm::length_t i = 0; i < 3; ++i) written[i] = vertex(part, triangle[i], *flat);
        scene_.triangles.push_back(written);
    }

    void addPoint(const MeshPart& part, uint32_t point) {
        if (isWithinReach(rounded_[point]))
            scene_.points.push_back(vertex(part, point, kUnread));
        else
            ++droppedStrokes_;
    }

    void addLine(const MeshPart& part, const glm::uvec2& line) {
        const glm::vec3 a = rounded_[line.x], b = rounded_[line.y];
        if (isWithinReach(a) && isWithinReach(b) && a != b)
            scene_.lines.emplace_back(vertex(part, line.x, kUnread), vertex(part, line.y, kUnread));
        else
            ++droppedStrokes_;
    }

    // Vertices are shared between triangles only where the file gives a normal to share.
    uint32_t vertex(const MeshPart& part, uint32_t index, const glm::vec3& flat) {
        if (!part.normals.empty() && indexOf_[index] != kUnassigned) return indexOf_[index];
        const auto written = static_cast<uint32_t>(scene_.positions.size());
        const bool hasUv = !part.uvs.empty() && isFinite(part.uvs[index]);
        scene_.positions.push_back(rounded_[index]);
        scene_.normals.push_back(part.normals.empty() ? flat
                                                      : unitNormal(part.normals[index]).value_or(flat));
        scene_.uvs.push_back(hasUv ? part.uvs[index] : glm::vec2(0));
        indexOf_[index] = written;
        return written;
    }

    Scene& scene_;
    std::vector<uint32_t> indexOf_;   // in the scene, of the part's vertices
    std::vector<glm::vec3> rounded_;  // the part's positions as the scene holds them
    size_t dropped_ = 0, droppedStrokes_ = 0;
};

// Appends a run, or lengthens the last one.
void addRange(std::vector<StrokeRange>& ranges, uint32_t material, size_t first, size_t end) {
    if (first == end) return;
    const auto count = static_cast<uint32_t>(end - first);
    if (!ranges.empty() && ranges.back().material == material)
        ranges.back().count += count;
    else
        ranges.push_back({material, static_cast<uint32_t>(first), count});
}

// Materials as they are for what has no normals.
class UnlitMaterials {
public:
    explicit UnlitMaterials(Scene& scene) : scene_(scene) {}

    uint32_t of(uint32_t material) {
        if (scene_.materials[material].unlit) return material;
        const auto [entry, isNew] =
            unlit_.try_emplace(material, static_cast<uint32_t>(scene_.materials.size()));
        if (isNew) {
            scene_.materials.push_back(Material(scene_.materials[material]));
            scene_.materials.back().unlit = true;
        }
        return entry->second;
    }

private:
    Scene& scene_;
    std::map<uint32_t, uint32_t> unlit_;
};

std::string counted(size_t count, const char* one, const char* several) {
    return std::to_string(count) + " " + (count == 1 ? one : several);
}

}  // namespace

void setGeometry(Scene& scene, const std::vector<MeshPart>& parts) {
    scene.originM = centreOf(parts);

    std::vector<const MeshPart*> byMaterial;
    byMaterial.reserve(parts.size());
    for (const MeshPart& part : parts) byMaterial.push_back(&part);
    std::stable_sort(byMaterial.begin(), byMaterial.end(),
                     [](const MeshPart* a, const MeshPart* b) { return a->material < b->material; });

    GeometryWriter writer(scene);
    UnlitMaterials unlit(scene);
    for (const MeshPart* part : byMaterial) {
        const auto first = static_cast<uint32_t>(scene.triangles.size());
        const size_t firstPoint = scene.points.size(), firstLine = scene.lines.size();
        writer.add(*part);
        if (scene.points.size() > firstPoint || scene.lines.size() > firstLine) {
            const uint32_t material = part->normals.empty() ? unlit.of(part->material) : part->material;
            addRange(scene.pointRanges, material, firstPoint, scene.points.size());
            addRange(scene.lineRanges, material, firstLine, scene.lines.size());
        }
        const auto count = static_cast<uint32_t>(scene.triangles.size()) - first;
        if (count == 0) continue;
        if (!scene.ranges.empty() && scene.ranges.back().material == part->material)
            scene.ranges.back().triangleCount += count;
        else
            scene.ranges.push_back({part->material, first, count});
    }
    scene.droppedTriangles = writer.dropped();
    if (writer.dropped() > 0)
        scene.notes.push_back("dropped " + counted(writer.dropped(), "triangle", "triangles") +
                              " with positions that are not finite or beyond 1e12 m, or zero area");
    if (writer.droppedStrokes() > 0)
        scene.notes.push_back("dropped " +
                              counted(writer.droppedStrokes(), "point or line", "points or lines") +
                              " with positions that are not finite or beyond 1e12 m, or zero length");
}

bool isEmpty(const Scene& scene) {
    return scene.triangles.empty() && scene.points.empty() && scene.lines.empty();
}

}  // namespace curvewall
