#pragma once
// Pixels that no error of less than a pixel explains.

#include "renderer/frame.h"

#include <cstdint>

namespace curvewall {

// `isClosed`: the left border goes on at the right one.

// Of two colour frames of one size: pixels with a channel off by more than 8 of 255 from all that the truth
// has there and at the eight pixels around.
uint64_t wrongPixels(const Frame& drawn, const Frame& truth, bool isClosed);

// Of two coverage frames of one size: pixels with fewer surfaces than the truth has at any of the nine. What
// is missing is a gap, even where something farther away shows through it.
uint64_t gapPixels(const Frame& drawn, const Frame& truth, bool isClosed);

}  // namespace curvewall
