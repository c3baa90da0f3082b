#pragma once
// The walls on which the ingredients are compared.

#include "calibration/pieces/piece_mesh.h"
#include "calibration/pieces/ray_image.h"
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
    RayImage rays;
    Surface surface;
    // Shapes of grids to choose from; 0 is one row.
    std::vector<double> rowsPerColumn;
};

std::vector<MeasuredWall> measuredWalls();

struct Measured {
    double maxPx = 0;   // over all pixels with a ray; infinite where one has no piece
    size_t pieces = 0;  // that own such a pixel
};

Measured measure(const RayImage& rays, const PieceMesh& mesh);

}  // namespace curvewall
