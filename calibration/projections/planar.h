#pragma once
// A flat screen given by three of its corners, seen by any eye that is not in its plane.

#include "calibration/projections/projection.h"

#include <glm/mat3x3.hpp>

namespace curvewall {

struct PlanarScreen {
    glm::dvec3 lowerLeftM, lowerRightM, upperLeftM;  // wall coordinates
};

class PlanarProjection : public Projection {
public:
    // Throws UsageError when the corners span no area, or the eye lies in the screen's plane or nearer to it
    // than 1/100,000 of its sides.
    PlanarProjection(const PlanarScreen& screen, glm::dvec3 eyeM, glm::ivec2 sizePx);

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override;
    std::vector<glm::dvec2> project(glm::dvec3 ray) const override;
    ProjectionPtr seenFrom(glm::dvec3 eyeM) const override;

    // Homogeneous; the third coordinate is 1 on the picture's plane.
    const glm::dmat3& pixelFromRay() const { return pixelFromRay_; }

private:
    PlanarScreen screen_;
    glm::ivec2 sizePx_;
    glm::dmat3 rayFromPixel_;  // columns: one pixel right, one pixel down, the top left corner
    glm::dmat3 pixelFromRay_;
};

}  // namespace curvewall
