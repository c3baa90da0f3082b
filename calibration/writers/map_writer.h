#pragma once
// Files of numbers as other programs read them. Row 0 of a map is its top row. All throw std::runtime_error
// where nothing can be written.

#include "calibration/files/map_file.h"

#include <string>

namespace curvewall {

// Float channels named R, G, B.
void writeExr(const std::string& path, const NumberMap& map);

// Little endian, the bottom row first, one or three channels.
std::string pfmBytes(const NumberMap& map);

void writeBytes(const std::string& path, const std::string& bytes);

}  // namespace curvewall
