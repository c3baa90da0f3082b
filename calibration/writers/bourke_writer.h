#pragma once
// Displays as meshes of Paul Bourke (http://paulbourke.net/dataformats/meshwarp) into a fisheye picture.

#include "calibration/writers/ray_grid.h"

#include <glm/vec2.hpp>

#include <string>

namespace curvewall {

// The equidistant fisheye that a mesh is made for; it just covers the display.
struct FisheyeSource {
    int sidePx = 0;
    double fovRad = 0;
    Orientation orientation;
};
FisheyeSource fisheyeSource(const RayGrid& grid, glm::ivec2 sizePx);

struct BourkeMesh {
    std::string text;
    bool hasIntensity = false;  // not one everywhere
};

// What encoded colours are multiplied by: linear light to the power of one over this.
inline constexpr double kIntensityGamma = 2.2;

// A rectangular mesh (type 2), the bottom row first. Its intensity is the mean of the blend's red, green and
// blue alpha; negative in holes. The grid goes from border to border.
BourkeMesh bourkeMesh(const Display& display, const RayGrid& grid, const FisheyeSource& source);

}  // namespace curvewall
