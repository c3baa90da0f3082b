#pragma once
// How many pieces a display needs at least, however they are cut.

#include "calibration/projections/projection.h"

#include <glm/vec2.hpp>

namespace curvewall {

// The integral over the display of 1 / A(p), with A(p) the area of the largest convex cell that has p and one
// homography within the tolerance: each piece of any mesh adds one at most. An estimate, since A(p) is
// searched for and looked at in some places only (docs/pieces.md says how near); at least 1. The cost does
// not depend on the display's size.
double lowerBoundOfPieces(const Projection& projection, glm::ivec2 sizePx, double tolerancePx);

}  // namespace curvewall
