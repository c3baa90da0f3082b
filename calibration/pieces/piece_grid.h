#pragma once
// Where a display is cut into columns and rows: closer where the projection bends more.

#include "calibration/pieces/piece_mesh.h"
#include "calibration/projections/projection.h"

#include <vector>

namespace curvewall {

// How many cells a stretch of the display needs, in each direction on its own. The error of a flat cell grows
// with the square of its width, so the density is the square root of the error that one pixel of width makes.
class BendProfile {
public:
    BendProfile(const Projection& projection, glm::ivec2 sizePx);

    // Cells over the whole display such that each is off by `errorPx` at most when its vertices are on the
    // surface.
    double columnsFor(double errorPx) const;
    double rowsFor(double errorPx) const;

    // A grid whose cells share the bend equally, vertices on the display's surface.
    PieceGrid grid(const Projection& projection, int columns, int rows) const;

private:
    glm::ivec2 sizePx_;
    std::vector<double> columnBend_, rowBend_;  // running sums, entry i at i / kSteps of the display
};

}  // namespace curvewall
