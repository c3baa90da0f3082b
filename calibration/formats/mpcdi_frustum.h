#pragma once
// What an MPCDI region's frustum, coordinate frame and lens extension mean.

#include "calibration/formats/decisions.h"
#include "calibration/formats/mpcdi_document.h"
#include "calibration/projections/frustum.h"
#include "calibration/projections/projection.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

namespace curvewall {

// What the region's own picture shows: its lens where the fisheye extension describes one, or else its
// frustum. Throws InputError where it has neither, and for a frustum of more than 178 degrees.
ProjectionPtr pictureOfRegion(const MpcdiRegion& region, glm::ivec2 sizePx, const std::string& path,
                              Decisions& decisions);

// From a position in the file's axes to one in the wall's: pitch points to the right, yaw down, roll ahead.
glm::dmat3 wallFromFrame(const MpcdiFrame& frame);

}  // namespace curvewall
