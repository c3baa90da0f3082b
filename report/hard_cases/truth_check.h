#pragma once
// Whether the reference is right: it casts rays in single precision, which hard cases are hard for as well.

#include "renderer/frame.h"
#include "report/hard_cases/family.h"

#include <cstdint>

namespace curvewall {

struct TruthCheck {
    uint64_t checkedPixels = 0;  // of those with a ray; all, or evenly spread ones where the scene is large
    uint64_t doubtfulPixels =
        0;                     // of these, so near to an edge or to the near limit that either may be right
    uint64_t wrongPixels = 0;  // of these, show another point or none
};

// Of the reference's positions: every triangle of the scene is met with the rays of pixels in double
// precision.
TruthCheck checkTruth(const Frame& position, const HardCase& tried);

}  // namespace curvewall
