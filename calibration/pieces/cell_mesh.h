#pragma once
// The pieces of a display that is cut into cells: one facet or two a cell, joined to their neighbours.

#include "calibration/pieces/cell_facets.h"
#include "calibration/pieces/facet_balance.h"

#include <cstdint>
#include <unordered_set>
#include <vector>

namespace curvewall {

struct CellMesh {
    PieceMesh mesh;
    Motion motion;                      // hanging vertices stay on their long edge
    std::vector<FacetSample> samples;   // pixel centres
    std::vector<uint32_t> cellOfPiece;  // in the tree
};

// Cells without a ray have no piece. Neighbours share their vertices, so that their pieces agree along the
// common edge, unless the display does not go on there (a fold, another part of a broken map), that is where
// their own planes are apart by more than `mostDisagreementPx`, or one of them is in `loose`: those are on
// their own planes, where nothing moves them, in one piece. Where a vertex lies within a neighbour's longer
// edge it hangs: both its point and its screen position are the same blend of the edge's ends.
//
// Cells of `flat`, in that order of importance, are one facet where a corner can be given up for it: that is
// where the other three put it, and none of those is given up. The others are two.
CellMesh meshOfCells(const CellTree& tree, const std::vector<CellFacets>& facets, const RayImage& rays,
                     const std::unordered_set<uint32_t>& loose, double mostDisagreementPx,
                     const std::vector<uint32_t>& flat = {});

}  // namespace curvewall
