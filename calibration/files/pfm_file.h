#pragma once
// Portable float maps, the usual container of warp maps: "PF" (three channels) or "Pf" (one), width, height
// and scale, separated by white space, one more white space character, and then the rows from the bottom up.
// The sign of the scale tells the byte order (negative: little endian). Its size is told and not applied:
// writers put 1 there, and what unit the numbers have is said by whoever names the file.

#include "calibration/files/file_bytes.h"
#include "calibration/files/map_file.h"

#include <string>
#include <string_view>

namespace curvewall {

// Whether the bytes begin like one.
bool isPfm(std::string_view bytes);

// Throws InputError unless the header is complete and exactly its data follows, and where the numbers make
// sense only in the other byte order than the header says. Row 0 is the last one of the file.
NumberMap parsePfm(const FileBytes& file, const AllowSize& allow = {});

// The same from a disk. Nothing readable is no PFM.
bool isPfmFile(const std::string& path);
NumberMap readPfm(const std::string& path);

}  // namespace curvewall
