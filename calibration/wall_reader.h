#pragma once
// Wall files (docs/wall-file.md).

#include <string>

#include "calibration/wall.h"

namespace curvewall {

// Throws InputError.
Wall readWall(const std::string& path);

}  // namespace curvewall
