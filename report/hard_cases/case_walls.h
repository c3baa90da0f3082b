#pragma once
// Walls of one display, as a wall file would have them, and their maps.

#include "calibration/wall.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <functional>

namespace curvewall::hard_cases {

// Through the reader of wall files, so that what is refused is refused as it would be there. Throws
// InputError.
WallPtr wallOf(const nlohmann::json& projection, glm::ivec2 sizePx, glm::dvec3 eyeM = {});

// The largest circle in the display shows `fovDeg`.
WallPtr fisheyeWall(const char* model, double fovDeg, glm::ivec2 sizePx);

// What most scenes are looked at through: 180 degrees ahead, which every method draws.
inline WallPtr domeMaster(int sizePx) { return fisheyeWall("equidistant", 180, glm::ivec2(sizePx)); }

// A full turn, 2 m around the origin, with equal scales along x and y.
WallPtr fullCylinderWall(glm::ivec2 sizePx, glm::dvec3 eyeM = {});

// The whole sphere.
WallPtr panoramaWall(glm::ivec2 sizePx);

// Offsets in pixels from where a position of the display, 0 to 1, would look in a flat picture 90 degrees
// wide, at nodes that lie from corner to corner. Not a number: not measured. Throws InputError.
using OffsetPx = std::function<glm::dvec2(glm::dvec2 at)>;
WallPtr measuredWall(glm::ivec2 nodes, const OffsetPx& offsetPx, glm::ivec2 sizePx);

}  // namespace curvewall::hard_cases
