#pragma once
// Pictures that show where a method is wrong.

#include "renderer/frame.h"

#include <glm/vec2.hpp>

#include <vector>

namespace curvewall {

// Of maps, which may be smaller than what they are of; then each pixel shows the worst of its block.
inline constexpr int kMapWidthPx = 640;

// Colours, from dark for a 16th of the tolerance to bright for 16 times as much, so that maps of one
// tolerance compare, and the scale below them. Grey where nothing is shown (NaN) or at a place that the
// display does not have (infinity). `errorsPx` row by row from the top. Throws std::runtime_error where the
// scale's font is not there.
Frame errorMap(const std::vector<float>& errorsPx, glm::ivec2 sizePx, double tolerancePx,
               int widthPx = kMapWidthPx);

// At most so wide; each pixel is the mean light of its block.
Frame reduced(const Frame& frame, int widthPx);

struct Square {
    glm::ivec2 cornerPx{0};  // top left
    int sidePx = 0;
};

// Moved to lie in the frame and cut where it is larger; each pixel becomes factor x factor.
Frame enlarged(const Frame& frame, Square square, int factor);

// Adds what pixels of a colour frame differ from the truth, row by row, the largest of their channels, of
// 255. `sum` is empty at first. Throws UsageError unless both are colour frames of one size.
void addDifference(std::vector<double>& sum, const Frame& drawn, const Frame& truth);

// Where such a sum is largest; of equal squares the first, row by row.
Square worstSquare(const std::vector<double>& sum, glm::ivec2 sizePx, int sidePx);

}  // namespace curvewall
