#pragma once
// Displays that unroll: flat screens and cylinders, where the cells of a grid are exact quads.

#include "calibration/pieces/facet_balance.h"
#include "calibration/pieces/piece_grid.h"

#include <optional>

namespace curvewall {

// Whether vertices on the display's surface make exact quads of every cell of a grid over it. Only a few
// places are looked at.
bool unrolls(const Projection& projection, glm::ivec2 sizePx);

struct BalancedGrid {
    BalancedPieces pieces;
    Motion motion;         // m = what its column adds + what its row adds
    glm::ivec2 counts{0};  // columns and rows
};

// A grid of so many columns and rows, placed as the bend asks for and balanced.
BalancedGrid balancedGrid(const Projection& projection, const BendProfile& profile, glm::ivec2 counts,
                          const std::stop_token& stop);

// Finds the coarsest grid on the line "columns and rows in the proportion that the bend asks for". A place on
// that line is its fineness; 1 is where facets on the surface would meet the tolerance.
class QuadGridSearch {
public:
    QuadGridSearch(const Projection& projection, glm::ivec2 sizePx, double tolerancePx,
                   const std::stop_token& stop);

    // The coarsest grid that meets the tolerance at the samples of the fit; nothing where the display breaks,
    // so that none does. Throws UsageError where that takes too many pieces.
    std::optional<BalancedGrid> coarsest();

    // The next grid with more cells than the last one returned, if that may help.
    std::optional<BalancedGrid> finer();

private:
    BalancedGrid at(double fineness) const;
    glm::dvec2 cellsAt(double fineness) const;
    double nextFiner(double fineness) const;
    bool hasGridBetween(double fails, double passes) const;
    double guess(double tried, double sampledMaxPx, double fails, double passes) const;

    const Projection& projection_;
    BendProfile profile_;
    double tolerancePx_;
    const std::stop_token& stop_;
    double fineness_ = 0;
};

}  // namespace curvewall
