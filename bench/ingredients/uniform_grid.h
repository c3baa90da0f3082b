#pragma once
// Fixed grids of two triangles a cell, which do not look where the error is.

#include "bench/ingredients/measured_wall.h"

namespace curvewall {

// As Lorenz and Doellner (2009), section 3.2: an even grid over the base image, its vertices where the map
// takes them. Displays without a base image have an even grid over their pixels and facets with their
// vertices at distance one.
PieceMesh paperGrid(const MeasuredWall& wall, glm::ivec2 cells);

// The same grid on the display's surface. Where there is none, vertices are as far from the eye as brings the
// middles of edges nearest to their places, by least squares.
PieceMesh gridOnSurface(const MeasuredWall& wall, glm::ivec2 cells);

// The grid on the surface with its vertices moved in space to balance the error.
PieceMesh balancedGrid(const MeasuredWall& wall, glm::ivec2 cells, double goodEnoughPx);

}  // namespace curvewall
