#pragma once
// Where the pictures of an image source look: axes around what a display shows.

#include "calibration/pieces/pixel_rays.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace curvewall {

// Axes of a perspective picture, of length one and at right angles to each other.
struct FaceAxes {
    glm::dvec3 right, down, ahead;
};

// Pixels that stand for a display: every so many-th, the outermost ones among them.
std::vector<glm::ivec2> latticeOf(glm::ivec2 sizePx, glm::ivec2 counts);

// Of the pixels that have a ray, of length one.
std::vector<glm::dvec3> directionsOf(const PixelRays& rays, const std::vector<glm::ivec2>& pixels);

// The axis of the narrowest cone around the directions. Its length is about the cosine of the cone's half
// angle: next to nothing where they span a half space or more.
glm::dvec3 axisOf(const std::vector<glm::dvec3>& directions);

// Axes that look ahead, with `right` as near as that allows.
FaceAxes axesAround(glm::dvec3 ahead, glm::dvec3 right);

// Some direction that is not along the other.
glm::dvec3 aside(glm::dvec3 direction);

enum class TurnAround { down, right, ahead };

FaceAxes turned(const FaceAxes& axes, TurnAround around, double angleRad);

}  // namespace curvewall
