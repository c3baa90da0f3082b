#include "calibration/projections/equirectangular_lens.h"

#include "calibration/projections/projection_maths.h"

#include <cmath>
#include <numbers>

namespace curvewall {

EquirectangularLens::EquirectangularLens(double horizontalFovRad, double verticalFovRad, glm::ivec2 sizePx)
    : columns_{horizontalFovRad, static_cast<double>(sizePx.x)},
      rows_{verticalFovRad, static_cast<double>(sizePx.y)} {}

std::optional<glm::dvec3> EquirectangularLens::direction(glm::dvec2 px) const {
    const glm::dvec2 angles(columns_.angleAt(px.x), -rows_.angleAt(px.y));
    if (!(std::abs(angles.y) <= std::numbers::pi / 2)) return std::nullopt;  // beyond a pole
    return maths::equirectangularDirection(angles);
}

std::vector<glm::dvec2> EquirectangularLens::positions(glm::dvec3 direction) const {
    const glm::dvec2 angles = maths::equirectangularAngles(direction);
    const double y = rows_.positionsOf(-angles.y).front();
    std::vector<glm::dvec2> positions;
    for (const double x : columns_.positionsOf(angles.x)) positions.emplace_back(x, y);
    return positions;
}

}  // namespace curvewall
