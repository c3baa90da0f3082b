#include "calibration/projections/cylinder.h"

#include "calibration/errors.h"
#include "calibration/projections/projection_maths.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace curvewall {

CylinderProjection::CylinderProjection(const CylinderWall& wall, glm::dvec3 eyeM, glm::ivec2 sizePx)
    : wall_(wall),
      sizePx_(sizePx),
      columns_{wall.arcRad, static_cast<double>(sizePx.x)},
      worldFromCylinder_(rotationFromOrientation(wall.orientation)) {
    eyeInCylinderM_ = glm::transpose(worldFromCylinder_) * (eyeM - wall.centerM);
    if (!(std::hypot(eyeInCylinderM_.x, eyeInCylinderM_.z) < wall.radiusM))
        throw UsageError("the eye is not inside the cylinder");
}

std::optional<glm::dvec3> CylinderProjection::unproject(glm::dvec2 px) const {
    const double yM = (0.5 - px.y / sizePx_.y) * wall_.heightM;
    return worldFromCylinder_ *
           (maths::cylinderPoint(wall_.radiusM, columns_.angleAt(px.x), yM) - eyeInCylinderM_);
}

std::vector<glm::dvec2> CylinderProjection::project(glm::dvec3 ray) const {
    const glm::dvec3 d = glm::transpose(worldFromCylinder_) * ray;
    if (!(d.x * d.x + d.z * d.z > 0)) return {};  // along the axis: the wall is never met
    const double t = maths::cylinderDistance(wall_.radiusM, eyeInCylinderM_, d);
    const glm::dvec2 position = maths::cylinderPosition(eyeInCylinderM_ + t * d);

    std::vector<glm::dvec2> positions;
    for (const double x : columns_.positionsOf(position.x))
        positions.emplace_back(x, (0.5 - position.y / wall_.heightM) * sizePx_.y);
    return positions;
}

ProjectionPtr CylinderProjection::seenFrom(glm::dvec3 eyeM) const {
    return std::make_shared<CylinderProjection>(wall_, eyeM, glm::ivec2(sizePx_));
}

}  // namespace curvewall
