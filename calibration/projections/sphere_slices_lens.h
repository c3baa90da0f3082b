#pragma once
// A fisheye view in planar slices at equal angles (Iu, "Fisheye rasterization"): each row is a plane through
// the x axis and samples the angle within it evenly.

#include "calibration/projections/angle_axis.h"
#include "calibration/projections/lens.h"

namespace curvewall {

class SphereSlicesLens : public Lens {
public:
    // `horizontalFovRad` within each plane, half a turn at most; `verticalFovRad` of planes, a turn at most.
    SphereSlicesLens(double horizontalFovRad, double verticalFovRad, glm::ivec2 sizePx);

    std::optional<glm::dvec3> direction(glm::dvec2 px) const override;
    std::vector<glm::dvec2> positions(glm::dvec3 direction) const override;

    const AngleAxis& columns() const { return columns_; }
    const AngleAxis& rows() const { return rows_; }

private:
    AngleAxis columns_;
    AngleAxis rows_;  // downwards
};

}  // namespace curvewall
