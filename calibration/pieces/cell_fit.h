#pragma once
// Any display: cells that are cut where the error is, with one facet or two each.

#include "calibration/pieces/cell_mesh.h"
#include "calibration/pieces/ray_image.h"

#include <stop_token>
#include <unordered_set>
#include <vector>

namespace curvewall {

// A display cut into cells, each with its own best plane.
struct CutDisplay {
    CellTree tree;
    std::vector<CellFacets> facets{};  // of every cell of the tree
    size_t pieceCount = 0;
    std::unordered_set<uint32_t> loose{};       // cells that have let go of their neighbours
    std::unordered_set<uint32_t> lonePixels{};  // that have nothing to do with what is around them
    std::vector<uint32_t> flat{};               // see meshOfCells
};

struct FittedCells {
    CellMesh pieces;
    CutDisplay cells;
};

// Pieces whose error is at most the tolerance at every pixel, and of which each pixel with a ray has one.
// Throws UsageError where that takes more than kMostPieces, and FitStopped.
FittedCells fitCells(const RayImage& rays, double tolerancePx, const std::stop_token& stop = {});

// The same for a display that has changed a little, from the cells of an earlier fit: those that fail are
// cut, the others only where the tolerance asks for it.
FittedCells refitCells(const RayImage& rays, double tolerancePx, CutDisplay cells,
                       const std::vector<uint32_t>& failing, const std::stop_token& stop = {});

}  // namespace curvewall
