#pragma once
// The methods that hard cases are drawn by, and what each has to hold.

#include "renderer/render.h"

#include <functional>
#include <string>
#include <vector>

namespace curvewall {

// Beyond any of these a picture is broken. Numbers that are none, points that the display has no place for
// and faults of coverage are never allowed.
struct StatedBounds {
    double maxPx = 0;       // geometric, of all pixels
    double p99Px = 0;       // and of 99 in 100
    double wrongShare = 0;  // of pixels of a colour that the truth has nowhere within a pixel
};

struct HardCaseMethod {
    std::string name;
    std::function<void(RenderRequest&)> choose;
    StatedBounds bounds;
};

const std::vector<HardCaseMethod>& hardCaseMethods();

}  // namespace curvewall
