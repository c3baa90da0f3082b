#include "calibration/projections/picture_views.h"

#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace curvewall {

MirroredProjection::MirroredProjection(ProjectionPtr picture, glm::dvec2 sizePx, bool inX, bool inY)
    : picture_(std::move(picture)), sizePx_(sizePx), inX_(inX), inY_(inY) {}

glm::dvec2 MirroredProjection::mirrored(glm::dvec2 px) const {
    return {inX_ ? sizePx_.x - px.x : px.x, inY_ ? sizePx_.y - px.y : px.y};
}

std::optional<glm::dvec3> MirroredProjection::unproject(glm::dvec2 px) const {
    return picture_->unproject(mirrored(px));
}

std::vector<glm::dvec2> MirroredProjection::project(glm::dvec3 ray) const {
    std::vector<glm::dvec2> positions = picture_->project(ray);
    for (glm::dvec2& px : positions) px = mirrored(px);
    return positions;
}

ProjectionPtr MirroredProjection::seenFrom(glm::dvec3 eyeM) const {
    return std::make_shared<MirroredProjection>(picture_->seenFrom(eyeM), sizePx_, inX_, inY_);
}

CroppedProjection::CroppedProjection(ProjectionPtr picture, glm::dvec2 lowPx, glm::dvec2 highPx)
    : picture_(std::move(picture)), lowPx_(lowPx), highPx_(highPx) {}

std::optional<glm::dvec3> CroppedProjection::unproject(glm::dvec2 px) const {
    if (glm::any(glm::lessThan(px, lowPx_)) || glm::any(glm::greaterThan(px, highPx_))) return std::nullopt;
    return picture_->unproject(px);
}

ProjectionPtr CroppedProjection::seenFrom(glm::dvec3 eyeM) const {
    return std::make_shared<CroppedProjection>(picture_->seenFrom(eyeM), lowPx_, highPx_);
}

PictureAtlas::PictureAtlas(std::vector<ProjectionPtr> pictures, glm::dvec2 pictureSizePx)
    : pictures_(std::move(pictures)), pictureSizePx_(pictureSizePx) {}

glm::dvec2 PictureAtlas::placePx(size_t picture) const {
    return {(3 * static_cast<double>(picture) + 1) * pictureSizePx_.x, 0};
}

glm::dvec2 PictureAtlas::sizePx() const {
    return {3 * static_cast<double>(pictures_.size()) * pictureSizePx_.x, pictureSizePx_.y};
}

std::optional<glm::dvec3> PictureAtlas::unproject(glm::dvec2 px) const {
    const double slot = std::floor(px.x / (3 * pictureSizePx_.x));
    if (!(slot >= 0 && slot < static_cast<double>(pictures_.size()))) return std::nullopt;
    const auto picture = static_cast<size_t>(slot);
    return pictures_[picture]->unproject(px - placePx(picture));
}

std::vector<glm::dvec2> PictureAtlas::project(glm::dvec3 ray) const {
    std::vector<glm::dvec2> positions;
    for (size_t picture = 0; picture < pictures_.size(); ++picture)
        for (const glm::dvec2 px : pictures_[picture]->project(ray))
            if (isInSlot(px)) positions.push_back(placePx(picture) + px);
    return positions;
}

bool PictureAtlas::isInSlot(glm::dvec2 pxOfPicture) const {
    return pxOfPicture.x >= -pictureSizePx_.x && pxOfPicture.x < 2 * pictureSizePx_.x;
}

bool PictureAtlas::dependsOnEye() const {
    return std::ranges::any_of(pictures_,
                               [](const ProjectionPtr& picture) { return picture->dependsOnEye(); });
}

ProjectionPtr PictureAtlas::seenFrom(glm::dvec3 eyeM) const {
    std::vector<ProjectionPtr> pictures;
    for (const ProjectionPtr& picture : pictures_) pictures.push_back(picture->seenFrom(eyeM));
    return std::make_shared<PictureAtlas>(std::move(pictures), pictureSizePx_);
}

}  // namespace curvewall
