#pragma once
// Facets that go with a display that has moved a little, without a look at its pixels.

#include "calibration/pieces/facet_balance.h"

#include <vector>

namespace curvewall {

// Every vertex goes with what the display shows at its screen position, in proportion to how far from the eye
// the facets are there: m + |m| / |before| (now - before), as near to that as `motion` lets them. That is
// exact where screen and display are related by a homography, whatever the facets' distances. Vertices at
// which the display shows nothing (NaN) go with their neighbours.
void follow(PieceMesh& mesh, const Motion& motion, const std::vector<glm::dvec3>& raysBefore,
            const std::vector<glm::dvec3>& raysNow);

}  // namespace curvewall
