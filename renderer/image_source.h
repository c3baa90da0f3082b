#pragma once
// Perspective pictures that the rays of a display are looked up in: the faces of a cube around the eye, or
// one picture that holds them all.

#include "calibration/pieces/certificate.h"
#include "calibration/pieces/piece_mesh.h"
#include "calibration/pieces/pixel_rays.h"
#include "calibration/wall.h"

#include <glm/vec4.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace curvewall {

enum class SourceKind { cube, planar };

// How the texels around a place become a pixel, in linear light.
enum class SourceFilter {
    nearest,
    linear,
    bicubic,  // Catmull-Rom: passes through the texels
};

// Axes of a perspective picture, of length one and at right angles to each other.
struct FaceAxes {
    glm::dvec3 right, down, ahead;
};

// Texels around a picture that no ray meets, so that filters reach across its border.
inline constexpr int kApronPx = 2;

// A picture of square texels on the plane at distance one.
struct SourceFace {
    FaceAxes axes;
    glm::dvec2 from;   // its top left corner on the plane
    double texel = 0;  // how wide a texel is there
    glm::ivec2 sizePx{0};

    // Where a ray that points ahead meets the picture, in texels, and the ray that meets it there.
    glm::dvec2 place(glm::dvec3 ray) const;
    glm::dvec3 ray(glm::dvec2 place) const;
};

struct ImageSource {
    int faceSizePx = 0;             // of a cube the texels along 90 degrees, of one picture its longer side
    std::vector<SourceFace> faces;  // those that the display sees, all of one size
};

// The face that looks along a ray.
size_t faceOf(const ImageSource& source, glm::dvec3 ray);

// How far, on the plane at distance one, the rays of the pixel and of its nearer neighbour, to the right or
// below, are apart. `axesOf` tells the axes that show a ray, or null; a neighbour that others show does not
// count.
using AxesOfRay = std::function<const FaceAxes*(glm::dvec3 ray)>;
std::optional<double> stepAt(const PixelRays& rays, glm::ivec2 px, const AxesOfRay& axesOf);

// The least of the steps but for the shortest hundredth: at the pole of a map of longitudes pixels are dense
// beyond all bounds. Nothing where there are none.
std::optional<double> leastStep(std::vector<double> steps);

// Faces with `faceSizePx` texels along 90 degrees. 0 takes one texel for one pixel where the display is
// densest, rounded up to a multiple of 16 and kept within kLeastFacePx and kMostAutomaticFacePx of
// request_limits.h.
ImageSource cubeSource(const PixelRays& rays, int faceSizePx);

// The face as a mesh of one piece; its facet is `distanceM` from the eye.
PieceMesh faceMesh(const SourceFace& face, double distanceM);

// For every pixel, row by row from the top: where its ray meets its face, in texels, the face, and 1; zero
// where there is no ray.
std::vector<glm::vec4> sourcePlaces(const ImageSource& source, const PixelRays& rays);

// How far the centre of the nearest texel lies from the pixel that shows it, in display pixels, over all
// pixels; those whose texel lies beyond what the display sees are left out.
Certificate sourceError(const ImageSource& source, const Display& display, const PixelRays& rays);

}  // namespace curvewall
