#pragma once
// What a conversion costs: how far the converted display shows everything from where the original shows it.

#include "calibration/wall.h"

#include <glm/vec2.hpp>

#include <cstdint>

namespace curvewall {

// Over all pixel centres p that see something in both displays: the distance from p to where the original
// shows what the converted display sees at p; the nearest place where it shows that several times.
struct ConversionError {
    double maxPx = 0;  // infinite where the original does not show it at all
    double p99Px = 0;
    double meanPx = 0;
    glm::ivec2 maxAt{0};
    int64_t holesGained = 0;     // pixels that see something in the original only
    int64_t holesLost = 0;       // pixels that see something in the converted display only
    double blendDifference = 0;  // the largest of any alpha or beta, in linear light
};

// Both are seen from the same eye and have the same size.
ConversionError conversionError(const Display& original, const Display& converted);

}  // namespace curvewall
