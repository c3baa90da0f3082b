#pragma once
// A grid over the pieces of a display for the question "which nodes of the tree can this sphere touch?",
// answered by a few look-ups instead of a walk.

#include "calibration/pieces/piece_tree.h"
#include "renderer/sphere_bounds.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <optional>
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

// Over the plane at distance one ahead, where a place is as in shaders/sphere_bounds.glsl.
struct NodeGrid {
    glm::dvec3 right{0}, down{0}, ahead{0};  // wall axes, of length one and at right angles
    glm::dvec2 least{0}, cellsPerUnit{0};
    int width = 0;                  // cells a side of the finest level, a power of two
    std::vector<NodeRange> ranges;  // the leaves over each cell, row by row and level by level
};

// Of the tree over these pieces with that guard. Nothing where they reach more than 75 degrees from their
// middle: there the plane stretches until cells mean nothing.
std::optional<NodeGrid> buildNodeGrid(const PieceMesh& mesh, std::span<const ConeNode> tree,
                                      double guardPx = kGuardPx);

// Holds every leaf whose piece, guard included, the sphere touches as the eye at the origin sees it.
NodeRange nodesUnder(const NodeGrid& grid, glm::dvec3 centre, double radius);

}  // namespace curvewall
