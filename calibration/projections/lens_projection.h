#pragma once
// A lens that stands somewhere: a display at infinity, or one that throws its picture on a dome.

#include "calibration/projections/lens.h"
#include "calibration/projections/pose.h"
#include "calibration/projections/projection.h"

#include <glm/mat3x3.hpp>

namespace curvewall {

struct DomeSurface {
    glm::dvec3 centerM{0};  // wall coordinates
    double radiusM = 1;
};

// What the lens shows lies at infinity: where it and the eye stand does not matter.
class LensProjection : public Projection {
public:
    LensProjection(LensPtr lens, const Orientation& orientation);

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override;
    std::vector<glm::dvec2> project(glm::dvec3 ray) const override;
    bool dependsOnEye() const override { return false; }
    ProjectionPtr seenFrom(glm::dvec3 eyeM) const override;

    const Lens& lens() const { return *lens_; }
    const glm::dmat3& worldFromLens() const { return worldFromLens_; }  // of rays; a rotation

private:
    LensPtr lens_;
    glm::dmat3 worldFromLens_;
};

// The lens throws its picture on the inside of a sphere and the eye sees it there: a projector in a dome, or
// a dome master seen from off the dome's centre.
class DomeProjection : public Projection {
public:
    // Throws UsageError unless the lens and the eye are inside the sphere.
    DomeProjection(LensPtr lens, const Pose& pose, const DomeSurface& dome, glm::dvec3 eyeM);

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override;
    std::vector<glm::dvec2> project(glm::dvec3 ray) const override;
    ProjectionPtr seenFrom(glm::dvec3 eyeM) const override;

    const Lens& lens() const { return *lens_; }
    const glm::dmat3& worldFromLens() const { return worldFromLens_; }  // of directions; a rotation
    glm::dvec3 lensM() const { return pose_.centerM; }
    glm::dvec3 eyeM() const { return eyeM_; }
    const DomeSurface& dome() const { return dome_; }

private:
    LensPtr lens_;
    Pose pose_;
    DomeSurface dome_;
    glm::dvec3 eyeM_;
    glm::dmat3 worldFromLens_;
};

}  // namespace curvewall
