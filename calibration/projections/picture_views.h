#pragma once
// Another projection's picture, mirrored or cut: what programs do with a finished picture before it is shown.

#include "calibration/projections/projection.h"

#include <glm/vec2.hpp>

#include <memory>
#include <vector>

namespace curvewall {

class MirroredProjection : public Projection {
public:
    // The picture has `sizePx`; left and right change places with `inX`, top and bottom with `inY`.
    MirroredProjection(ProjectionPtr picture, glm::dvec2 sizePx, bool inX, bool inY);

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override;
    std::vector<glm::dvec2> project(glm::dvec3 ray) const override;
    bool dependsOnEye() const override { return picture_->dependsOnEye(); }
    ProjectionPtr seenFrom(glm::dvec3 eyeM) const override;

private:
    glm::dvec2 mirrored(glm::dvec2 px) const;

    ProjectionPtr picture_;
    glm::dvec2 sizePx_;
    bool inX_, inY_;
};

class CroppedProjection : public Projection {
public:
    // Shows nothing outside the rectangle.
    CroppedProjection(ProjectionPtr picture, glm::dvec2 lowPx, glm::dvec2 highPx);

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override;
    std::vector<glm::dvec2> project(glm::dvec3 ray) const override { return picture_->project(ray); }
    bool dependsOnEye() const override { return picture_->dependsOnEye(); }
    ProjectionPtr seenFrom(glm::dvec3 eyeM) const override;

    const Projection& picture() const { return *picture_; }

private:
    ProjectionPtr picture_;
    glm::dvec2 lowPx_, highPx_;
};

// Several pictures of one size in a row, so that one mesh can take from all of them.
class PictureAtlas : public Projection {
public:
    // At least one picture.
    PictureAtlas(std::vector<ProjectionPtr> pictures, glm::dvec2 pictureSizePx);

    // Pictures are two of their sizes apart: a mesh may reach beyond a picture's border by half of that, and
    // sees there how the picture's formula goes on.
    glm::dvec2 placePx(size_t picture) const;  // of its top left corner
    glm::dvec2 sizePx() const;                 // of everything

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override;
    std::vector<glm::dvec2> project(glm::dvec3 ray) const override;
    bool dependsOnEye() const override;
    ProjectionPtr seenFrom(glm::dvec3 eyeM) const override;

private:
    bool isInSlot(glm::dvec2 pxOfPicture) const;

    std::vector<ProjectionPtr> pictures_;
    glm::dvec2 pictureSizePx_;
};

}  // namespace curvewall
