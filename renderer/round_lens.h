#pragma once
// Displays at infinity with a lens that is round about its axis: those that bounded-raycast draws.

#include "calibration/projections/radial_lens.h"
#include "calibration/wall.h"

#include <glm/mat3x3.hpp>

namespace curvewall {

struct RoundLens {
    glm::ivec2 sizePx{0};
    RadialFunction function;
    glm::dvec2 centrePx{0};
    glm::dvec2 focalPx{1};
    double edgeRad = 0;  // off the axis; the picture shows nothing further
    glm::dmat3 wallFromLens{1};

    bool operator==(const RoundLens&) const = default;
};

// Throws UsageError where the display is of another kind.
RoundLens roundLensOf(const Display& display);

// Whether a sphere, its centre relative to the eye in lens axes, may reach into what the lens shows.
bool reachesInto(const RoundLens& lens, glm::vec3 centre, float radius);

}  // namespace curvewall
