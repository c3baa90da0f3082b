#pragma once
// Pieces that follow a moving eye, or a map that is animated: the cuts stay, the facets follow the screen.

#include "calibration/pieces/piece_fit.h"

namespace curvewall {

// The lattice of a certificate that is in a hurry.
inline constexpr int kSparseRows = 8;

// The pieces of `before` for the same display as it is now: at another eye, or with another map. Certified at
// every `every`-th row and column from the first, where the maximum is at most `tolerancePx`; between them
// nobody has looked. A refit with `every` 1 of what a refit has given completes its certificate.
//
// Vertices follow the display's surface. Where that does not meet the tolerance the facets around are
// balanced, then cells that still fail are cut (a grid places its columns and rows anew), and in the end all
// is fitted anew. Owners and basis are those of `before`, the very same, as long as nothing is cut or placed
// anew and the display's outline stays. Throws as fitPieces does.
FittedPieces refitPieces(const FittedPieces& before, const Projection& now, double tolerancePx, int every,
                         const std::stop_token& stop = {});

// The same for a display of a wall, whose name errors begin with; at once where its projection is the one
// that the pieces are of.
FittedPieces refitPieces(const FittedPieces& before, const Display& now, double tolerancePx, int every,
                         const std::stop_token& stop = {});

}  // namespace curvewall
