#pragma once
// A rendered picture in memory.

#include "renderer/look.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <limits>
#include <vector>

namespace curvewall {

// Row 0 is the top row; texels are interleaved. Colour has 3 channels in linear light, depth 1 (metres from
// the eye, infinity where nothing is drawn), coverage 1 (fragments), position 3 (metres, eye-relative, wall
// axes, NaN where nothing is drawn).
struct Frame {
    glm::ivec2 sizePx{0};
    int channels = 0;
    std::vector<float> texels;

    const float* at(int x, int y) const {
        return &texels[(static_cast<size_t>(y) * static_cast<size_t>(sizePx.x) + static_cast<size_t>(x)) *
                       static_cast<size_t>(channels)];
    }
};

constexpr int channelsOf(OutputKind output) {
    return output == OutputKind::color || output == OutputKind::position ? 3 : 1;
}

// The texel of a pixel that shows nothing of the scene.
inline std::array<float, 3> emptyTexel(OutputKind output, glm::vec3 background) {
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    switch (output) {
        case OutputKind::color:
            return {background.r, background.g, background.b};
        case OutputKind::depth:
            return {kInfinity, 0, 0};
        case OutputKind::coverage:
            return {0, 0, 0};
        case OutputKind::position:
            return {kNaN, kNaN, kNaN};
    }
    return {};
}

}  // namespace curvewall
