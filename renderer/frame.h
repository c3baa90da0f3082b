#pragma once
// A rendered picture in memory.

#include <glm/vec2.hpp>

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

}  // namespace curvewall
