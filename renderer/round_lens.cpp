#include "renderer/round_lens.h"

#include "calibration/errors.h"
#include "calibration/projections/lens_projection.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

const LensProjection* projectionOf(const Display& display) {
    return dynamic_cast<const LensProjection*>(display.projection.get());
}

const RadialLens& lensOf(const Display& display) {
    const LensProjection* const projection = projectionOf(display);
    const auto* const lens = projection ? dynamic_cast<const RadialLens*>(&projection->lens()) : nullptr;
    if (lens) return *lens;
    const bool isOnDome = dynamic_cast<const DomeProjection*>(display.projection.get()) != nullptr;
    throw UsageError(
        "bounded-raycast draws round lenses seen from the lens: radial, curvilinear, a fisheye camera; "
        "display \"" +
        display.name + "\" is " + display.projectionType +
        (isOnDome ? " on a dome, which its eye and its lens see differently" : ""));
}

// The farthest that a corner of the picture looks off the axis, where the lens's edge is not nearer.
double shownEdgeRad(const RadialLens& lens, glm::ivec2 sizePx) {
    const glm::dvec2 farthestPx = glm::max(lens.centrePx(), glm::dvec2(sizePx) - lens.centrePx());
    const double radius = glm::length(farthestPx / lens.focalPx());
    const RadialFunction& function = lens.function();
    if (radius >= function.radius(lens.edgeRad())) return lens.edgeRad();
    return maths::radialAngle(static_cast<int>(function.model), function.coefficients.data(), radius,
                              lens.edgeRad());
}

}  // namespace

RoundLens roundLensOf(const Display& display) {
    const RadialLens& lens = lensOf(display);
    return {display.sizePx,
            lens.function(),
            lens.centrePx(),
            lens.focalPx(),
            shownEdgeRad(lens, display.sizePx),
            projectionOf(display)->worldFromLens()};
}

bool reachesInto(const RoundLens& lens, glm::vec3 centre, float radius) {
    constexpr double kRoundingRad = 1e-5;
    const double distance = glm::length(centre);
    if (distance <= radius) return true;
    const double offAxisRad = std::atan2(std::hypot(centre.x, centre.y), -centre.z);
    return offAxisRad - std::asin(radius / distance) <= lens.edgeRad + kRoundingRad;
}

}  // namespace curvewall
