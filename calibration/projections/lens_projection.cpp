#include "calibration/projections/lens_projection.h"

#include "calibration/errors.h"
#include "calibration/projections/projection_maths.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <utility>

namespace curvewall {
namespace {

glm::dvec3 pointOnDome(const DomeSurface& dome, glm::dvec3 fromM, glm::dvec3 ray) {
    return fromM + maths::sphereDistance(dome.radiusM, fromM - dome.centerM, ray) * ray;
}

}  // namespace

LensProjection::LensProjection(LensPtr lens, const Orientation& orientation)
    : lens_(std::move(lens)), worldFromLens_(rotationFromOrientation(orientation)) {}

std::optional<glm::dvec3> LensProjection::unproject(glm::dvec2 px) const {
    const auto direction = lens_->direction(px);
    if (!direction) return std::nullopt;
    return worldFromLens_ * *direction;
}

std::vector<glm::dvec2> LensProjection::project(glm::dvec3 ray) const {
    return lens_->positions(glm::transpose(worldFromLens_) * ray);
}

ProjectionPtr LensProjection::seenFrom(glm::dvec3) const { return std::make_shared<LensProjection>(*this); }

DomeProjection::DomeProjection(LensPtr lens, const Pose& pose, const DomeSurface& dome, glm::dvec3 eyeM)
    : lens_(std::move(lens)),
      pose_(pose),
      dome_(dome),
      eyeM_(eyeM),
      worldFromLens_(rotationFromOrientation(pose.orientation)) {
    const auto isInside = [&](glm::dvec3 pointM) {
        return glm::distance(pointM, dome.centerM) < dome.radiusM;
    };
    if (!isInside(pose.centerM)) throw UsageError("the lens is not inside the dome");
    if (!isInside(eyeM)) throw UsageError("the eye is not inside the dome");
}

std::optional<glm::dvec3> DomeProjection::unproject(glm::dvec2 px) const {
    const auto direction = lens_->direction(px);
    if (!direction) return std::nullopt;
    return pointOnDome(dome_, pose_.centerM, worldFromLens_ * *direction) - eyeM_;
}

std::vector<glm::dvec2> DomeProjection::project(glm::dvec3 ray) const {
    return lens_->positions(glm::transpose(worldFromLens_) *
                            (pointOnDome(dome_, eyeM_, ray) - pose_.centerM));
}

ProjectionPtr DomeProjection::seenFrom(glm::dvec3 eyeM) const {
    return std::make_shared<DomeProjection>(lens_, pose_, dome_, eyeM);
}

}  // namespace curvewall
