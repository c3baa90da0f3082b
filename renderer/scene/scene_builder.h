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
};

// Fills the scene's origin and geometry, sorted by material. Triangles that cannot be drawn are left out and
// counted in the notes.
void setGeometry(Scene& scene, const std::vector<MeshPart>& parts);

}  // namespace curvewall
