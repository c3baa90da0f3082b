#pragma once
// How far pixels are from some of them.

#include <glm/vec2.hpp>

#include <cstdint>
#include <vector>

namespace curvewall {

// The distance from every pixel to the nearest marked one, centre to centre, row by row from the top;
// infinity everywhere where none is marked. Exact to float's precision.
std::vector<float> distancesToMarked(const std::vector<uint8_t>& marked, glm::ivec2 sizePx);

}  // namespace curvewall
