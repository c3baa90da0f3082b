#pragma once
// What the picture shows that a map or a mesh bends onto a display, where the file does not say it.

#include "calibration/formats/calibration_file.h"
#include "calibration/formats/decisions.h"

namespace curvewall {

// The user's, or else an assumption: a perspective view straight ahead, a dome master or a panorama.
// `sizePx` is the picture's, whose shape decides the vertical field of view.
SourcePicture decideSource(const CalibrationRequest& request, glm::ivec2 sizePx, Decisions& decisions);

}  // namespace curvewall
