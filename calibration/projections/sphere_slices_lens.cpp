#include "calibration/projections/sphere_slices_lens.h"

#include "calibration/projections/projection_maths.h"

#include <cmath>
#include <numbers>

namespace curvewall {

namespace {
constexpr double kAheadRad = std::numbers::pi / 2;  // within a plane, from the left end of the x axis
}

SphereSlicesLens::SphereSlicesLens(double horizontalFovRad, double verticalFovRad, glm::ivec2 sizePx)
    : columns_{horizontalFovRad, static_cast<double>(sizePx.x)},
      rows_{verticalFovRad, static_cast<double>(sizePx.y)} {}

std::optional<glm::dvec3> SphereSlicesLens::direction(glm::dvec2 px) const {
    const double angleRad = columns_.angleAt(px.x);
    if (!(std::abs(angleRad) <= kAheadRad)) return std::nullopt;  // beyond an end of the axis
    return maths::sphereSlicesDirection({kAheadRad + angleRad, -rows_.angleAt(px.y)});
}

std::vector<glm::dvec2> SphereSlicesLens::positions(glm::dvec3 direction) const {
    const glm::dvec2 angles = maths::sphereSlicesAngles(direction);
    const double x = columns_.positionsOf(angles.x - kAheadRad).front();
    std::vector<glm::dvec2> positions;
    for (const double y : rows_.positionsOf(-angles.y)) positions.emplace_back(x, y);
    return positions;
}

}  // namespace curvewall
