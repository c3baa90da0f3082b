#pragma once
// The walls on which the ingredients are compared.

#include "calibration/pieces/piece_mesh.h"
#include "calibration/projections/projection.h"

#include <string>
#include <vector>

namespace curvewall {

// Where facets can lie that look at nothing but the projection.
enum class Surface {
    measured,  // unproject ends on it
    image,     // a plane one unit ahead, all of which the display shows
    infinity,  // there is none
};

struct MeasuredWall {
    std::string name;
    ProjectionPtr projection;
    ProjectionPtr continued;  // has a ray at vertices that lie in holes
    glm::ivec2 sizePx;
    Surface surface;
    // Shapes of grids to choose from; 0 is one row.
    std::vector<double> rowsPerColumn;
    // Grids of a multiple of so many columns have lines where those of the display's measured map are; 0 is a
    // display without a map. Between such lines a map is smooth, so these grids may be better than finer
    // ones.
    int mapColumns = 0;
};

std::vector<MeasuredWall> measuredWalls();

struct Measured {
    double maxPx = 0;
    size_t pieces = 0;
};

// The certified maximum and the pieces that own a pixel with a ray. Where a look at some of the pixels shows
// more than the tolerance, the maximum over those, and pieces are not counted.
Measured measure(const Projection& projection, const PieceMesh& mesh, double tolerancePx);

}  // namespace curvewall
