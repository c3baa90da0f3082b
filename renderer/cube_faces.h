#pragma once
// Cube map faces as one-piece meshes, and what a display needs of them. Face order and axes as OpenGL's
// (specification 4.5, table 8.19), so that a face can be drawn straight into a cube map layer.

#include "calibration/pieces/certificate.h"
#include "calibration/wall.h"

#include <array>
#include <vector>

namespace curvewall {

// The unit ray of every pixel centre, row by row from the top; zero where there is none.
std::vector<glm::vec4> displayRays(const Display& display);

// The face that looks along a ray, and where the ray meets it: 0 to 1 from texel row and column 0.
int cubeFaceOf(glm::vec3 ray);
glm::dvec2 cubeFacePosition(glm::dvec3 ray, int face);
glm::dvec3 cubeFaceRay(glm::dvec2 position, int face);

// The face as a mesh of one piece; its facet is `distanceM` from the eye.
PieceMesh cubeFaceMesh(int face, int faceSizePx, double distanceM);

// One texel of the face for one pixel where the display is densest but for a hundredth of it, rounded up to a
// multiple of 16 and kept within kLeastFacePx and kMostAutomaticFacePx of request_limits.h.
int faceSizeFor(const Display& display, const std::vector<glm::vec4>& rays);

// Faces whose texels are read when the rays are filtered linearly.
std::array<bool, 6> facesSeen(const std::vector<glm::vec4>& rays, int faceSizePx);

// How far the centre of the nearest texel lies from the pixel that shows it, in display pixels, over all
// pixels; those whose texel lies beyond what the display sees are left out.
Certificate cubeError(const Display& display, const std::vector<glm::vec4>& rays, int faceSizePx);

}  // namespace curvewall
