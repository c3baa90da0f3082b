#pragma once
// EXR files of numbers, several times faster than OpenImageIO reads them. OpenEXR's C interface holds every
// size in a header against the size of the file before it takes memory for it; its C++ interface, on which
// OpenImageIO builds, believes the header.

#include "calibration/files/map_file.h"

#include <string>

namespace curvewall {

// The first part of a file, of scan lines or the finest level of tiles, in any compression but
// B44 and DWA: one to four channels of half or float. R, G and B come first and A comes last, the others keep
// the order of their names. `allow` as for readNumberMap. Throws InputError.
NumberMap readExr(const std::string& path);
NumberMap readExr(const FileBytes& file, const AllowSize& allow = {});

}  // namespace curvewall
