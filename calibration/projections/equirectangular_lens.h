#pragma once
// Columns linear in longitude, rows in latitude: panoramas and the source pictures of most players.

#include "calibration/projections/angle_axis.h"
#include "calibration/projections/lens.h"

namespace curvewall {

class EquirectangularLens : public Lens {
public:
    // The width may span more than a turn, the height half a turn at most.
    EquirectangularLens(double horizontalFovRad, double verticalFovRad, glm::ivec2 sizePx);

    std::optional<glm::dvec3> direction(glm::dvec2 px) const override;
    std::vector<glm::dvec2> positions(glm::dvec3 direction) const override;

    const AngleAxis& columns() const { return columns_; }
    const AngleAxis& rows() const { return rows_; }

private:
    AngleAxis columns_;
    AngleAxis rows_;  // downwards
};

}  // namespace curvewall
