#pragma once
// A grid over the pieces of a display for the question "which nodes of the tree can this sphere touch?",
// answered by a few look-ups instead of a walk.

#include "calibration/pieces/piece_tree.h"
#include "renderer/sphere_bounds.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace curvewall {

namespace maths {

using glm::ivec2;

#define SHARED_FN inline
#include "shaders/node_grid.glsl"
#undef SHARED_FN

}  // namespace maths

// Nodes from x up to y; none where y is not beyond x.
using NodeRange = glm::uvec2;
inline constexpr NodeRange kNoNodes{0xffffffffu, 0u};

// Square cells over the plane at distance one ahead, where a place is as in shaders/sphere_bounds.glsl.
struct GridPlane {
    glm::dvec3 right{0}, down{0}, ahead{0};  // wall axes, of length one and at right angles
    glm::dvec2 least{0}, cellsPerUnit{0};    // of the finest level
};

inline constexpr size_t kMostGridPlanes = 6;

struct NodeGrid {
    std::vector<GridPlane> planes;
    int width = 0;                  // cells a side of the finest level, a power of two
    std::vector<NodeRange> ranges;  // the leaves over each cell: plane by plane, level by level, row by row
};

// Of the tree over these pieces with that guard: one plane where all lie within 75 degrees of their middle,
// otherwise the sides of a cube that they touch.
NodeGrid buildNodeGrid(const PieceMesh& mesh, std::span<const ConeNode> tree, double guardPx = kGuardPx);

// Cells of all levels of one plane.
constexpr int cellsOfPlane(int width) { return (4 * width * width - 1) / 3; }

// Holds every leaf whose piece, guard included, the sphere touches as the eye at the origin sees it.
NodeRange nodesUnder(const NodeGrid& grid, glm::dvec3 centre, double radius);

}  // namespace curvewall
