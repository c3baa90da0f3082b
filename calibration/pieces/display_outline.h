#pragma once
// The convex region that a display's picture fills.

#include "calibration/projections/projection.h"

#include <glm/vec2.hpp>

#include <vector>

namespace curvewall {

// Positions with dot(normal, px) <= offset; the normal has length one and points out.
struct HalfPlane {
    glm::dvec2 normal{0};
    double offset = 0;

    double depthOf(glm::dvec2 px) const { return offset - (normal.x * px.x + normal.y * px.y); }
};

// Half-planes whose common part holds all positions with a ray and hardly more than their convex hull: the
// display's sides and, where it shows nothing in its corners, tangents that cut those off. The cost does not
// depend on the size. Empty where no ray was found.
std::vector<HalfPlane> displayOutline(const Projection& projection, glm::ivec2 sizePx);

}  // namespace curvewall
