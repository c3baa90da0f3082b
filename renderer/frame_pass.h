#pragma once
// One of the passes that together make a frame of many samples.

#include <glm/vec2.hpp>

namespace curvewall {

struct FramePass {
    glm::vec2 shiftPx{0};  // the picture is drawn that much further right and down
    int samples = 1;       // of a pixel in this pass; one is its centre, shifted
    int firstSample = 0;   // of those of the whole frame
    float lodBias = 0;     // of textures: the footprint of one of many samples is smaller than a pixel
};

}  // namespace curvewall
