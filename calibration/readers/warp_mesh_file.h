#pragma once
// Warp meshes in JSON, a form for every mesh that other programs write:
//
//     { "grid": [columns, rows], "vertices": [[x, y, u, v, intensity], null, ...] }
//     { "triangles": [[a, b, c], ...], "vertices": [...] }
//
// The intensity may be absent (1); null is a vertex that was not measured. A grid's vertices come row by row.

#include "calibration/formats/mesh_calibration.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace curvewall {

struct MeshFile {
    std::optional<glm::ivec2> grid;                   // vertices in x and y, two at least
    std::vector<std::array<uint32_t, 3>> triangles;   // where there is no grid
    std::vector<std::optional<MeshVertex>> vertices;  // in whatever units whoever names the file says
};

// Throws InputError.
MeshFile readMeshFile(const std::string& path);

}  // namespace curvewall
