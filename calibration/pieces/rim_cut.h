#pragma once
// Where a round display ends within the cells of its facets.

#include "calibration/pieces/faceted_height.h"

#include <vector>

namespace curvewall {

// The corners of every cell, in px. Where the display ends within cells, their edges end a little outside of
// it, or facets would reach over the hole. An edge is cut once for both of its cells, so that they still meet
// corner to corner.
std::vector<std::vector<glm::dvec2>> cellsCutAtRim(const FacetedHeight& faceted);

}  // namespace curvewall
