#pragma once
// Small groups of triangles near each other, so that coverage can leave many triangles out with one look.

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace curvewall {

// Enough that a look at a meshlet is cheap beside those at its triangles, few enough that its sphere is
// small.
inline constexpr uint32_t kMeshletTriangles = 64;

struct Meshlet {
    uint32_t firstTriangle = 0;  // in the new order
    uint32_t triangleCount = 0;
    // Holds every vertex, rounded outwards.
    glm::vec3 centreM{0};
    float radiusM = 0;
    // See shaders/meshlet_cone.glsl. A meshlet whose normals span half a turn or more has an endless reach.
    glm::vec3 coneAxis{0, 0, 1};
    float coneSine = 0;
    float coneCosine = 1;
    float coneReachM = 0;
};

struct Meshlets {
    std::vector<uint32_t> order;  // of the triangles: which one comes to each place
    std::vector<Meshlet> meshlets;
};

// Cuts a run of triangles (corners in `positions`, counter-clockwise seen from the front) into meshlets of at
// most `mostTriangles`, a multiple of 4 up to 512. Vertices at one place count as one, whatever their
// normals, so that soup holds together. Meshlets come in the order of their first triangles, which stay in
// order within each.
Meshlets cutIntoMeshlets(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                         uint32_t mostTriangles = kMeshletTriangles);

// The same without changing the order: so many triangles in a row are a meshlet.
Meshlets cutInOrder(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                    uint32_t mostTriangles = kMeshletTriangles);

// True only where every triangle of the meshlet is seen from behind.
bool isBehind(const Meshlet& meshlet, glm::vec3 eyeM);

}  // namespace curvewall
