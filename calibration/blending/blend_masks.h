#pragma once
// Alpha masks for the displays of a wall that overlap: on every ray the masks of the displays that show it
// sum to one, in linear light.

#include "calibration/wall.h"

#include <glm/vec2.hpp>

#include <vector>

namespace curvewall {

// Values from 0 to 1 in steps of 1/65535, row by row from the top. 1 where no other display shows the same
// ray. In a display that overlaps another one, pixels without a ray are 0: their light would fall into a
// neighbour's picture.
struct BlendMask {
    std::vector<float> values;
    double overlapShare = 0;  // pixels that another display shows as well, of those with a ray
};

// How far the masks of the displays that show the ray of a pixel's centre are from a sum of one, the other
// displays' looked up bilinearly.
//
// Where the borders of two displays cross, each mask has to fall to zero at its own border and is one at the
// other's: within a few pixels of such a point no masks of pixels can sum to one.
struct BlendSum {
    double shareOff = 0;  // pixels that are off by more than one per cent, of those with a ray
    double largestDeviation = 0;
    size_t display = 0;  // where that is
    glm::ivec2 pixel{0};
};

struct BlendMasks {
    std::vector<BlendMask> displays;  // as in the wall
    BlendSum sum;                     // over every pixel with a ray
};

BlendMasks makeBlendMasks(const Wall& wall);

}  // namespace curvewall
