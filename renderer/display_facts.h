#pragma once
// What a display asks of any method that draws it: how much it shows, and how straight lines bend on it.

#include "calibration/wall.h"

#include <glm/vec3.hpp>

namespace curvewall {

struct DisplayFacts {
    double shownPx = 0;        // pixels that have a ray
    double solidAngleSr = 0;   // of what they see
    glm::dvec3 axis{0, 0, 1};  // the middle of what it sees, of length one
    double reachRad = 0;       // how far from the axis it sees; half a turn where it has no middle
    // How far the image of a line bends away from a straight stroke of one pixel's length, at most; that of a
    // stroke of n pixels bends n^2 times as far. Infinite where the display is not continuous somewhere in
    // what it shows, as at a pole.
    double bendPx = 0;
};

// Looks at some thousand places, so that what is smaller than the way from one to the next may be missed.
DisplayFacts factsOf(const Display& display);

// How far strokes of `lengthPx` may be off on that display.
double strokeErrorPx(const DisplayFacts& facts, double lengthPx);

}  // namespace curvewall
