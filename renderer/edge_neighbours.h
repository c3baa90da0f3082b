#pragma once
// What lies across the edges of a mesh, for the styles that draw edges. Triangles are neighbours where their
// corners are at the same places, since normals and texture coordinates split vertices.

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace curvewall {

// Folds sharper than this are creases.
inline constexpr double kLeastCreaseDeg = 35;

struct EdgeNeighbour {
    static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

    uint32_t corner = kNone;  // the vertex of the neighbour that is not on the edge
    bool isCrease = false;

    bool exists() const { return corner != kNone; }
};

// Three a triangle; edge i is the one opposite corner i.
std::vector<EdgeNeighbour> edgeNeighbours(std::span<const glm::vec3> positions,
                                          std::span<const glm::uvec3> triangles);

}  // namespace curvewall
