#pragma once
// The largest convex cell around a point that one homography shows within a tolerance, or the one that
// weighs most.

#include "calibration/pieces/display_outline.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include <optional>
#include <vector>

namespace curvewall {

// What a pixel of the display weighs: ((dot(direction, px) - originPx) / reachPx) ^ power.
struct PixelWeight {
    glm::dvec2 direction{1, 0};
    double originPx = 0;
    double reachPx = 1;
    int power = 0;  // even; at most 8

    double at(glm::dvec2 px) const;
};

struct ConvexCell {
    std::vector<glm::dvec2> corners;  // of a polygon, in order around it
    double weight = 0;
    glm::dmat3 screenFromRay{1};

    bool has(glm::dvec2 px) const;
};

// A heavy cell of many corners within the outline that has `px`, found by growing a small one for as long as
// its homography, which grows along, keeps the rays of places on its border and inside within the tolerance.
// Holes within it have no say and count as area. That ends in a local optimum; `stretch` (a direction, and
// its length a proportion) is the shape of the first cell. Nothing where none was found to begin with: in
// holes and where neighbouring positions have nothing to do with each other.
std::optional<ConvexCell> largestCell(const Projection& projection, const std::vector<HalfPlane>& outline,
                                      const PixelWeight& weight, glm::dvec2 px, double tolerancePx,
                                      glm::dvec2 stretch);

// How far the ray of a position lands from it; infinity where it points the other way, 0 in holes.
double errorPx(const Projection& projection, const glm::dmat3& screenFromRay, glm::dvec2 px);

}  // namespace curvewall
