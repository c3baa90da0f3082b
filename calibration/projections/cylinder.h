#pragma once
// A cylindrical wall seen from anywhere inside it. Column x is linear in angle, row y linear in height.
// Source: the horizontal cylinder of Lorenz and Doellner (2009), section 3.1, here for any eye.

#include "calibration/projections/angle_axis.h"
#include "calibration/projections/pose.h"
#include "calibration/projections/projection.h"

#include <glm/mat3x3.hpp>

namespace curvewall {

struct CylinderWall {
    double radiusM = 1;
    double arcRad = 0;  // may be a full turn or more
    double heightM = 1;
    glm::dvec3 centerM{0};    // the middle of the axis, wall coordinates
    Orientation orientation;  // at zero the middle column looks along -z and the axis is y
};

class CylinderProjection : public Projection {
public:
    // Throws UsageError when the eye is not inside the cylinder (nearer to its axis than the radius).
    CylinderProjection(const CylinderWall& wall, glm::dvec3 eyeM, glm::ivec2 sizePx);

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override;
    std::vector<glm::dvec2> project(glm::dvec3 ray) const override;
    ProjectionPtr seenFrom(glm::dvec3 eyeM) const override;

    const CylinderWall& wall() const { return wall_; }
    const glm::dmat3& worldFromCylinder() const { return worldFromCylinder_; }  // a rotation
    glm::dvec3 eyeInCylinderM() const { return eyeInCylinderM_; }               // from the middle of the axis

private:
    CylinderWall wall_;
    glm::dvec2 sizePx_;
    AngleAxis columns_;
    glm::dmat3 worldFromCylinder_;
    glm::dvec3 eyeInCylinderM_;
};

}  // namespace curvewall
