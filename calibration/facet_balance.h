#pragma once
// Moves the facets' vertices so that the largest error over the display becomes small.

#include "calibration/piece_grid.h"

namespace curvewall {

struct BalancedPieces {
    PieceMesh mesh;
    double sampledMaxPx = 0;  // over a lattice of samples in every piece, its borders included
};

// Vertices keep their screen positions; their points m move in three dimensions. Starting from m on the
// surface, Gauss-Newton steps on the true screen error with Lawson's reweighting lead from the least squares
// fit towards the smallest maximum (C. L. Lawson, 1961). A grid of exact quads stays one: it is moved as m(i,
// j) = u(i) + v(j), which every parallelogram grid is, so exactness is a constraint and not a tolerance.
BalancedPieces balanceFacets(const Projection& projection, PieceGrid grid);

}  // namespace curvewall
