#pragma once
// Portable float maps, the usual container of warp maps: "PF" (three channels) or "Pf" (one), width, height
// and scale, separated by white space, one more white space character, and then the rows from the bottom up.
// The sign of the scale tells the byte order (negative: little endian). Its size is not applied: writers put
// 1 there, and what unit the numbers have is said by whoever names the file.

#include "calibration/files/map_file.h"

#include <string>

namespace curvewall {

// Whether the file begins like one. Nothing readable does not.
bool isPfm(const std::string& path);

// Throws InputError unless the header is complete and exactly its data follows.
NumberMap readPfm(const std::string& path);

}  // namespace curvewall
