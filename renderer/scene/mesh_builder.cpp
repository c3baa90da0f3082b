#include "renderer/scene/mesh_builder.h"

#include <glm/geometric.hpp>

#include <utility>

namespace curvewall {

MeshBuilder::MeshBuilder(size_t expectedTriangles) {
    // Quads make two vertices a triangle; what is above that finds room in the slack.
    const size_t vertices = expectedTriangles * 9 / 4;
    positions_.reserve(vertices);
    normals_.reserve(vertices);
    uvs_.reserve(vertices);
}

uint32_t MeshBuilder::addCorners(std::span<const Corner> corners, glm::vec3 normal) {
    const auto first = static_cast<uint32_t>(positions_.size());
    const glm::vec3 unit = glm::normalize(normal);
    for (const Corner& corner : corners) {
        positions_.push_back(corner.positionM);
        normals_.push_back(unit);
        uvs_.push_back(corner.uv);
    }
    return first;
}

void MeshBuilder::addTriangle(CityMaterial material, glm::uvec3 corners) {
    triangles_[static_cast<size_t>(material)].push_back(corners);
    ++triangleCount_;
}

void MeshBuilder::triangle(CityMaterial material, const Corner& a, const Corner& b, const Corner& c) {
    const uint32_t first =
        addCorners(std::array{a, b, c}, glm::cross(b.positionM - a.positionM, c.positionM - a.positionM));
    addTriangle(material, {first, first + 1, first + 2});
}

void MeshBuilder::quad(CityMaterial material, const Corner& a, const Corner& b, const Corner& c,
                       const Corner& d) {
    const uint32_t first =
        addCorners(std::array{a, b, c, d}, glm::cross(c.positionM - a.positionM, d.positionM - b.positionM));
    addTriangle(material, {first, first + 1, first + 2});
    addTriangle(material, {first, first + 2, first + 3});
}

void MeshBuilder::smoothBody(CityMaterial material, std::span<const Corner> corners,
                             std::span<const glm::vec3> normals, std::span<const glm::uvec3> triangles) {
    const auto first = static_cast<uint32_t>(positions_.size());
    for (size_t i = 0; i < corners.size(); ++i) {
        positions_.push_back(corners[i].positionM);
        normals_.push_back(glm::normalize(normals[i]));
        uvs_.push_back(corners[i].uv);
    }
    for (const glm::uvec3& t : triangles) addTriangle(material, first + t);
}

void MeshBuilder::paintedTriangle(Paint paint, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const glm::vec2 uv = paintUv(paint);
    triangle(CityMaterial::paint, {a, uv}, {b, uv}, {c, uv});
}

void MeshBuilder::paintedQuad(Paint paint, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
    const glm::vec2 uv = paintUv(paint);
    quad(CityMaterial::paint, {a, uv}, {b, uv}, {c, uv}, {d, uv});
}

void MeshBuilder::paintedFrustum(Paint paint, const Box& box, float topScale, BoxFaces faces) {
    const glm::vec3 low = box.lowM, high = box.highM;
    const glm::vec3 inset = (high - low) * (0.5f * (1 - topScale));
    const std::array<glm::vec3, 4> bottom{
        {{low.x, low.y, high.z}, {high.x, low.y, high.z}, {high.x, low.y, low.z}, {low.x, low.y, low.z}}};
    const std::array<glm::vec3, 4> top{{{low.x + inset.x, high.y, high.z - inset.z},
                                        {high.x - inset.x, high.y, high.z - inset.z},
                                        {high.x - inset.x, high.y, low.z + inset.z},
                                        {low.x + inset.x, high.y, low.z + inset.z}}};
    for (size_t i = 0; i < 4; ++i) {
        const size_t next = (i + 1) % 4;
        paintedQuad(paint, bottom[i], bottom[next], top[next], top[i]);
    }
    if (faces != BoxFaces::sides) paintedQuad(paint, top[0], top[1], top[2], top[3]);
    if (faces == BoxFaces::all) paintedQuad(paint, bottom[3], bottom[2], bottom[1], bottom[0]);
}

void MeshBuilder::moveInto(Scene& scene) {
    scene.positions = std::move(positions_);
    scene.normals = std::move(normals_);
    scene.uvs = std::move(uvs_);
    scene.triangles.reserve(triangleCount_);
    for (uint32_t m = 0; m < kCityMaterials; ++m) {
        if (triangles_[m].empty()) continue;
        scene.ranges.push_back(
            {m, static_cast<uint32_t>(scene.triangles.size()), static_cast<uint32_t>(triangles_[m].size())});
        scene.triangles.insert(scene.triangles.end(), triangles_[m].begin(), triangles_[m].end());
        triangles_[m] = {};
    }
}

MeshBuilder::Mark MeshBuilder::mark() const {
    Mark mark{positions_.size(), triangleCount_, {}};
    for (size_t m = 0; m < kCityMaterials; ++m) mark.triangles[m] = triangles_[m].size();
    return mark;
}

void MeshBuilder::rollBack(const Mark& mark) {
    positions_.resize(mark.vertices);
    normals_.resize(mark.vertices);
    uvs_.resize(mark.vertices);
    for (size_t m = 0; m < kCityMaterials; ++m) triangles_[m].resize(mark.triangles[m]);
    triangleCount_ = mark.triangleCount;
}

}  // namespace curvewall
