#pragma once
// What blended displays show together on a ray, by their exact projections.

#include "calibration/blending/blend_masks.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace curvewall::test {

inline float maskAt(const BlendMask& mask, glm::ivec2 sizePx, int x, int y) {
    x = std::clamp(x, 0, sizePx.x - 1);
    y = std::clamp(y, 0, sizePx.y - 1);
    return mask.values[static_cast<size_t>(y) * static_cast<size_t>(sizePx.x) + static_cast<size_t>(x)];
}

inline double bilinear(const BlendMask& mask, glm::ivec2 sizePx, glm::dvec2 px) {
    const int x = static_cast<int>(std::floor(px.x - 0.5)), y = static_cast<int>(std::floor(px.y - 0.5));
    const double fx = px.x - 0.5 - x, fy = px.y - 0.5 - y;
    return (1 - fx) * (1 - fy) * maskAt(mask, sizePx, x, y) + fx * (1 - fy) * maskAt(mask, sizePx, x + 1, y) +
           (1 - fx) * fy * maskAt(mask, sizePx, x, y + 1) + fx * fy * maskAt(mask, sizePx, x + 1, y + 1);
}

// Positive inside.
inline double distanceToBorderPx(glm::ivec2 sizePx, glm::dvec2 px) {
    const glm::dvec2 inside = glm::min(px, glm::dvec2(sizePx) - px);
    if (inside.x >= 0 && inside.y >= 0) return std::min(inside.x, inside.y);
    return -glm::length(glm::max(-inside, glm::dvec2(0)));
}

struct BlendedLight {
    double light = 0;     // full light is 1
    int displays = 0;     // that show the ray
    int bordersNear = 0;  // displays with their border within 12 px
};

inline BlendedLight blendedLight(const Wall& wall, const BlendMasks& masks, glm::dvec3 ray) {
    BlendedLight sum;
    for (size_t i = 0; i < wall.displays.size(); ++i) {
        const Display& display = wall.displays[i];
        for (const glm::dvec2 px : display.projection->project(ray)) {
            const double distance = distanceToBorderPx(display.sizePx, px);
            sum.bordersNear += std::abs(distance) < 12;
            if (distance < 0) continue;
            ++sum.displays;
            sum.light += bilinear(masks.displays[i], display.sizePx, px);
        }
    }
    return sum;
}

}  // namespace curvewall::test
