#include "calibration/projections/camera_texture.h"

#include <utility>

namespace curvewall {

CameraTexture::CameraTexture(std::shared_ptr<const GridMap> map, ProjectionPtr base, MapDirection direction)
    : map_(std::move(map)), base_(std::move(base)), direction_(direction) {}

std::optional<glm::dvec3> CameraTexture::unproject(glm::dvec2 px) const {
    const auto inBase = direction_ == MapDirection::forward ? map_->frontPosition(px) : map_->at(px);
    return inBase ? base_->unproject(*inBase) : std::nullopt;
}

std::vector<glm::dvec2> CameraTexture::project(glm::dvec3 ray) const {
    std::vector<glm::dvec2> positions;
    for (const glm::dvec2 inBase : base_->project(ray)) {
        if (direction_ == MapDirection::inverse) {
            for (const glm::dvec2 px : map_->positions(inBase)) addIfNew(positions, px);
        } else if (const auto px = map_->at(inBase)) {
            addIfNew(positions, *px);
        }
    }
    return positions;
}

ProjectionPtr CameraTexture::seenFrom(glm::dvec3 eyeM) const {
    return std::make_shared<CameraTexture>(map_, base_->seenFrom(eyeM), direction_);
}

}  // namespace curvewall
