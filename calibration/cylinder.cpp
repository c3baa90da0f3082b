#include "calibration/cylinder.h"

#include "calibration/errors.h"

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
    const glm::dvec3 pointM(wall_.radiusM * std::sin(angleRad), (0.5 - px.y / sizePx_.y) * wall_.heightM,
                            -wall_.radiusM * std::cos(angleRad));
    return worldFromCylinder_ * (pointM - eyeInCylinderM_);
}

std::vector<glm::dvec2> CylinderProjection::project(glm::dvec3 ray) const {
    const glm::dvec3 d = glm::transpose(worldFromCylinder_) * ray;
    const glm::dvec3& o = eyeInCylinderM_;
    // The one root ahead of an eye inside: a t^2 + 2 b t + c = 0 with c < 0, written without cancellation.
    const double a = d.x * d.x + d.z * d.z;
    const double b = o.x * d.x + o.z * d.z;
    const double c = o.x * o.x + o.z * o.z - wall_.radiusM * wall_.radiusM;
    if (!(a > 0)) return {};  // along the axis: the wall is never met
    const double root = std::sqrt(b * b - a * c);
    const double t = b > 0 ? -c / (b + root) : (root - b) / a;
    const glm::dvec3 pointM = o + t * d;

    const double turn = std::atan2(pointM.x, -pointM.z) / wall_.arcRad + 0.5;
    // Rounding may leave the full turn's last column at x = width, which is its first.
    const bool fullTurn = wall_.arcRad > 2 * std::numbers::pi - 1e-12;
    const double x = (fullTurn ? turn - std::floor(turn) : turn) * sizePx_.x;
    return {{fullTurn && x >= sizePx_.x ? 0.0 : x, (0.5 - pointM.y / wall_.heightM) * sizePx_.y}};
}

}  // namespace curvewall
