#pragma once
// One cell on its own: the facets that it would have if it had no neighbours, and how far they are off.

#include "calibration/pieces/cell_tree.h"
#include "calibration/pieces/piece_mesh.h"
#include "calibration/pieces/pixel_rays.h"

#include <array>
#include <vector>

namespace curvewall {

// Corners of a cell: top left, top right, bottom right, bottom left.
std::array<glm::ivec2, 4> cornersOf(const Cell& cell);

// Corners of the two facets, the diagonal falling from the top left or rising from the bottom left.
using FacetCorners = std::array<std::array<uint32_t, 3>, 2>;
const FacetCorners& facetCorners(bool fallingDiagonal);

// Which of the two facets has the pixel's centre.
size_t facetAt(const Cell& cell, bool fallingDiagonal, glm::ivec2 px);

// A pixel that has a ray.
struct SeenPixel {
    glm::ivec2 px{0};
    glm::dvec3 ray{0};
};

// Pixels with a ray on a lattice of at most `perAxis` x `perAxis`, the cell's outermost pixels included.
// Where the lattice finds none but the cell has some, the first of them.
std::vector<SeenPixel> latticePixels(const PixelRays& rays, const Cell& cell, int perAxis);

struct CellFacets {
    std::array<glm::dvec3, 4> corners{};  // of the one plane that fits its pixels best
    double errorPx = 0;                   // over a lattice of pixels
    int pixelCount = 0;                   // of that lattice
    bool isEmpty = false;                 // no pixel of the cell has a ray
    bool isThin = false;                  // those that have one are a line, or hardly more
};

// The larger error of a cell's pixels when its facets have these corners.
double facetErrorPx(const PixelRays& rays, const Cell& cell, const std::array<glm::dvec3, 4>& corners,
                    bool fallingDiagonal, const std::vector<SeenPixel>& pixels);

CellFacets facetsOf(const PixelRays& rays, const Cell& cell);

// Those of a single pixel that has nothing to do with what is around it.
CellFacets facetsOfLonePixel(const PixelRays& rays, const Cell& cell);

// How far a pixel's ray lands from its centre; in a thin cell, if that is more, how far from there the
// display has the ray that is shown at the centre. The two are about the same where the facet is as steep as
// the display, but between pixels in a line nothing else sees to that.
double facetErrorPx(const PixelRays& rays, const SeenPixel& pixel, const glm::dmat3& screenFromRay,
                    bool isThin);

struct Cut {
    int axis = -1;                       // across which a cell is cut; -1 for a cell of one pixel
    std::array<CellFacets, 2> halves{};  // that this makes
};

// The cut that leaves the least to do.
Cut bestCut(const PixelRays& rays, const Cell& cell);

}  // namespace curvewall
