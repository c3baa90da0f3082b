#pragma once
// The methods that hard cases are drawn by, and what each has to hold.

#include "renderer/render.h"

#include <functional>
#include <string>
#include <vector>

namespace curvewall {

// Beyond these a picture is broken. Numbers that are none and gaps are never allowed.
struct StatedBounds {
    double maxPx = 0;  // geometric, of all pixels
    double p99Px = 0;  // and of 99 in 100
};

// Of a display: so many pixels may have a colour that the truth has nowhere within a pixel, as many show what
// is not there, and as many what the display has no place for. What is thinner than a pixel a sample meets or
// not by chance, along lines as long as the display is wide and high, a quarter of a pixel to either side.
inline double mostWrongPixels(glm::ivec2 sizePx) { return 0.25 * (sizePx.x + sizePx.y); }

struct HardCaseMethod {
    std::string name;
    std::function<void(RenderRequest&)> choose;
    StatedBounds bounds;
};

const std::vector<HardCaseMethod>& hardCaseMethods();

}  // namespace curvewall
