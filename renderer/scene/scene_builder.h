#pragma once
// From meshes in double precision, as files describe them, to the arrays of a Scene.

#include "renderer/scene/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace curvewall {

// Every index is smaller than positionsM.size(); normals and uvs have as many entries as positions or none.
struct MeshPart {
    uint32_t material = 0;
    std::vector<glm::dvec3> positionsM;  // scene coordinates
    std::vector<glm::dvec3> normals;     // of any length; none: flat
    std::vector<glm::vec2> uvs;
    std::vector<glm::uvec3> triangles;  // counter-clockwise seen from the front
    std::vector<uint32_t> points;
    std::vector<glm::uvec2> lines;

    size_t primitiveCount() const { return triangles.size() + points.size() + lines.size(); }
};

// Along each axis from the scene's origin. Facing is the sign of a product of three lengths, which leave
// single precision from 7e12 m on.
inline constexpr float kFarthestVertexM = 1e12f;

// Fills the scene's origin and geometry, sorted by material. What cannot be drawn is left out and counted in
// the notes. Points and lines without normals get an unlit material, as glTF 2.0 demands (section 3.7.2.1).
void setGeometry(Scene& scene, const std::vector<MeshPart>& parts);

// Whether it has neither triangles nor points nor lines.
bool isEmpty(const Scene& scene);

}  // namespace curvewall
