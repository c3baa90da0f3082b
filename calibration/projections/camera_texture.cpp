#include "calibration/projections/camera_texture.h"

#include <glm/matrix.hpp>

#include <cmath>
#include <utility>

namespace curvewall {

CameraTexture::CameraTexture(std::shared_ptr<const GridMap> map, const BaseImage& base,
                             MapDirection direction)
    : map_(std::move(map)), direction_(direction) {
    const double left = std::tan(base.leftRad), right = std::tan(base.rightRad);
    const double down = std::tan(base.downRad), up = std::tan(base.upRad);
    const glm::dmat3 localFromBase(glm::dvec3((right - left) / map_->sizePx().x, 0, 0),
                                   glm::dvec3(0, (down - up) / map_->sizePx().y, 0),
                                   glm::dvec3(left, up, -1));
    rayFromBase_ = rotationFromOrientation(base.orientation) * localFromBase;
    baseFromRay_ = glm::inverse(rayFromBase_);
}

std::optional<glm::dvec3> CameraTexture::unproject(glm::dvec2 px) const {
    const auto base = direction_ == MapDirection::forward ? map_->frontPosition(px) : map_->at(px);
    if (!base) return std::nullopt;
    return rayFromBase_ * glm::dvec3(*base, 1.0);
}

std::vector<glm::dvec2> CameraTexture::project(glm::dvec3 ray) const {
    const glm::dvec3 h = baseFromRay_ * ray;
    if (!(h.z > 0)) return {};  // in the plane through the eye or behind it
    const glm::dvec2 base = glm::dvec2(h) / h.z;
    if (direction_ == MapDirection::inverse) return map_->positions(base);
    if (const auto px = map_->at(base)) return {*px};
    return {};
}

ProjectionPtr CameraTexture::seenFrom(glm::dvec3 /*eyeM*/) const {
    return std::make_shared<CameraTexture>(*this);
}

}  // namespace curvewall
