#pragma once
// Pixels that no error of less than a pixel explains.

#include "renderer/frame.h"

#include <cstdint>

namespace curvewall {

// Of two colour frames of one size: pixels with a channel off by more than 8 of 255 from all that the truth
// has there and at the eight pixels around. `isClosed`: the left border goes on at the right one.
uint64_t wrongPixels(const Frame& drawn, const Frame& truth, bool isClosed);

}  // namespace curvewall
