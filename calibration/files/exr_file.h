#pragma once
// The EXR files that maps usually come in, read several times faster than OpenImageIO reads them.

#include "calibration/files/map_file.h"

#include <optional>
#include <string>

namespace curvewall {

// Plain scan lines of half or float channels named R, G, B, A or Y, uncompressed or in ZIP or ZIPS. Nothing
// for any other file and for a damaged one: another reader may know more about it.
std::optional<NumberMap> readPlainExr(const std::string& path);

}  // namespace curvewall
