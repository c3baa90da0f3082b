#include "calibration/cylinder.h"

#include "calibration/errors.h"
#include "calibration/projection_maths.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <numbers>

namespace curvewall {

CylinderProjection::CylinderProjection(const CylinderWall& wall, glm::dvec3 eyeM, glm::ivec2 sizePx)
    : wall_(wall), sizePx_(sizePx), worldFromCylinder_(rotationFromOrientation(wall.orientation)) {
    eyeInCylinderM_ = glm::transpose(worldFromCylinder_) * (eyeM - wall.centerM);
    if (!(std::hypot(eyeInCylinderM_.x, eyeInCylinderM_.z) < wall.radiusM))
        throw UsageError("the eye is not inside the cylinder");
}

std::optional<glm::dvec3> CylinderProjection::unproject(glm::dvec2 px) const {
    const double angleRad = (px.x / sizePx_.x - 0.5) * wall_.arcRad;
    const double yM = (0.5 - px.y / sizePx_.y) * wall_.heightM;
    return worldFromCylinder_ * (maths::cylinderPoint(wall_.radiusM, angleRad, yM) - eyeInCylinderM_);
}

std::vector<glm::dvec2> CylinderProjection::project(glm::dvec3 ray) const {
    const glm::dvec3 d = glm::transpose(worldFromCylinder_) * ray;
    if (!(d.x * d.x + d.z * d.z > 0)) return {};  // along the axis: the wall is never met
    const double t = maths::cylinderDistance(wall_.radiusM, eyeInCylinderM_, d);
    const glm::dvec2 position = maths::cylinderPosition(eyeInCylinderM_ + t * d);

    const double turn = position.x / wall_.arcRad + 0.5;
    // Rounding may leave the full turn's last column at x = width, which is its first.
    const bool fullTurn = wall_.arcRad > 2 * std::numbers::pi - 1e-12;
    const double x = (fullTurn ? turn - std::floor(turn) : turn) * sizePx_.x;
    return {{fullTurn && x >= sizePx_.x ? 0.0 : x, (0.5 - position.y / wall_.heightM) * sizePx_.y}};
}

ProjectionPtr CylinderProjection::seenFrom(glm::dvec3 eyeM) const {
    return std::make_shared<CylinderProjection>(wall_, eyeM, glm::ivec2(sizePx_));
}

}  // namespace curvewall
