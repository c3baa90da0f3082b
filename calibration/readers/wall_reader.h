#pragma once
// Walls from disk: wall files, JSON as docs/wall-file.md describes it, and the calibrations that other
// programs leave (docs/formats.md), which are walls by themselves.

#include "calibration/files/file_bytes.h"
#include "calibration/wall.h"

#include <glm/vec2.hpp>

#include <optional>
#include <string>

namespace curvewall {

// `sizePx` is for a calibration that names no resolution. Throws InputError that names the file, the field,
// what was expected and what was found, and UsageError for a size where a wall file has one for each display.
Wall readWall(const std::string& path, std::optional<glm::ivec2> sizePx = {});

// A wall file by itself. Throws InputError.
Wall readWallFile(const FileBytes& file);

}  // namespace curvewall
