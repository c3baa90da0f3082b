#pragma once
// Wall files: JSON as docs/wall-file.md describes it.

#include "calibration/wall.h"

#include <string>

namespace curvewall {

// Throws InputError that names the file, the field, what was expected and what was found.
Wall readWall(const std::string& path);

}  // namespace curvewall
