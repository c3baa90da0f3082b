#pragma once
// Perspective pictures that the rays of a display are looked up in: the faces of a cube around the eye, or
// one picture that holds them all.

#include "calibration/pieces/certificate.h"
#include "calibration/pieces/piece_mesh.h"
#include "calibration/pieces/pixel_rays.h"
#include "calibration/wall.h"
#include "renderer/source_axes.h"

#include <glm/vec4.hpp>

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace curvewall {

enum class SourceKind { cube, hemicube, planar };

// How the texels around a place become a pixel, in linear light.
enum class SourceFilter {
    nearest,
    linear,
    bicubic,      // Catmull-Rom: passes through the texels
    mipmap,       // trilinear: linear in the two levels whose texels are about as wide as a pixel
    anisotropic,  // the same at up to 16 places along what the pixel covers, for one that covers a long strip
};

constexpr bool usesLevels(SourceFilter filter) {
    return filter == SourceFilter::mipmap || filter == SourceFilter::anisotropic;
}

// Texels around a picture that no ray meets, so that filters reach across its border.
inline constexpr int kApronPx = 2;

// A pixel that covers more texels than 2 to this power is filtered as if it covered that many.
inline constexpr int kMostLevels = 5;

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
    std::vector<SourceFace> faces;  // those that the display sees, each as far as it sees them
    int levels = 0;                 // of halved pictures beside the whole ones
    int apronPx = kApronPx;
};

// Where a ray that points ahead meets the plane at distance one.
glm::dvec2 onPlane(const FaceAxes& axes, glm::dvec3 ray);

// The axes that look along a ray the most, the first of them where several do.
size_t mostAhead(std::span<const FaceAxes> axes, glm::dvec3 ray);

// The face that looks along a ray.
size_t faceOf(const ImageSource& source, glm::dvec3 ray);

// A size that holds every face and can be halved `levels` times.
glm::ivec2 layerSizeOf(const ImageSource& source);

// What drawing all faces fills.
uint64_t texelCountOf(const ImageSource& source);

// How far, on the plane at distance one, a step of a pixel goes at least, in whatever direction of the
// display: by the neighbours to the right and below, whose lattice may lie askew on the plane. `axesOf` tells
// the axes that show a ray, or null; a neighbour that others show does not count.
using AxesOfRay = std::function<const FaceAxes*(glm::dvec3 ray)>;
std::optional<double> stepAt(const PixelRays& rays, glm::ivec2 px, const AxesOfRay& axesOf);

// The least of the steps but for the shortest hundredth: at the pole of a map of longitudes pixels are dense
// beyond all bounds. Nothing where there are none.
std::optional<double> leastStep(std::vector<double> steps);

// The face as a mesh of one piece; its facet is `distanceM` from the eye.
PieceMesh faceMesh(const SourceFace& face, double distanceM);

// For every pixel, row by row from the top: where its ray meets its face, in texels, the face, and 1; zero
// where there is no ray.
std::vector<glm::vec4> sourcePlaces(const ImageSource& source, const PixelRays& rays);

// For every pixel, how far its place moves, on its own face, to the next pixel (xy) and to the next row (zw),
// in texels; between its two neighbours where both have a ray that meets the face's plane.
std::vector<glm::vec4> sourceGradients(const ImageSource& source, const PixelRays& rays);

// The same source with as many levels as the pixels need that cover the most texels, but for one in a
// hundred, and with aprons so wide that no filter at any level reaches beyond a picture.
ImageSource withLevels(ImageSource source, const PixelRays& rays);

// How far the centre of the nearest texel lies from the pixel that shows it, in display pixels, over all
// pixels with a place; those whose texel lies beyond what the display sees are left out.
Certificate sourceError(const ImageSource& source, const std::vector<glm::vec4>& places,
                        const Display& display);

// The same of the places themselves, for those that are not exact.
Certificate lookupError(const ImageSource& source, const std::vector<glm::vec4>& places,
                        const Display& display);

}  // namespace curvewall
