#pragma once
// A display as a map of numbers: the points that its pixels light, or the positions of a perspective image
// that they show.

#include "calibration/files/map_file.h"
#include "calibration/writers/ray_grid.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace curvewall {

// Relative to `originM`, metres, in the wall's axes: points of the display where it has any, and else points
// one metre from the eye. NaN in holes.
NumberMap surfacePoints(const RayGrid& grid, glm::dvec3 eyeM, glm::dvec3 originM);

// How far from its own place on the display, in pixels, each node's ray lies in an image that shows the
// frustum and has the display's size. NaN in holes.
NumberMap imageOffsets(const RayGrid& grid, const Frustum& frustum, glm::ivec2 sizePx);

// Where it lies there as fractions of the image, from the top left, and 0. NaN in holes.
NumberMap imageFractions(const RayGrid& grid, const Frustum& frustum);

}  // namespace curvewall
