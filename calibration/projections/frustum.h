#pragma once
// A flat picture at infinity, given by the angles of its four sides: what most calibration files call a
// frustum. Eyes anywhere see it alike.

#include "calibration/projections/pose.h"
#include "calibration/projections/projection.h"

#include <glm/mat3x3.hpp>

namespace curvewall {

// Angles from -z; right and up are positive, so that left and down are negative where the axis is inside.
struct Frustum {
    double leftRad = 0, rightRad = 0, downRad = 0, upRad = 0;
    Orientation orientation;
};

// A ray ends on the picture's plane, one unit ahead of the eye.
class FrustumProjection : public Projection {
public:
    // Throws UsageError unless left is below right, down is below up, and all are within a quarter turn.
    FrustumProjection(const Frustum& frustum, glm::dvec2 sizePx);

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override;
    std::vector<glm::dvec2> project(glm::dvec3 ray) const override;
    bool dependsOnEye() const override { return false; }
    ProjectionPtr seenFrom(glm::dvec3 eyeM) const override;

    // Homogeneous; the third coordinate is 1 on the picture's plane.
    const glm::dmat3& pixelFromRay() const { return pixelFromRay_; }

private:
    glm::dmat3 rayFromPixel_;
    glm::dmat3 pixelFromRay_;
};

}  // namespace curvewall
