#pragma once
// Walls as MPCDI archives, version 1.0: profile a3d where a display is a real surface or sees too much for a
// frustum, else 3d.

#include "calibration/wall.h"

#include <string>
#include <vector>

namespace curvewall {

// Displays become regions of one buffer, side by side, with a map of one node a pixel. Surface points are
// relative to the eye. `scratch` is the path of a file that may be written meanwhile.
void writeMpcdi(const std::string& path, const std::vector<const Display*>& displays,
                const std::string& scratch);

}  // namespace curvewall
