#include "calibration/projections/grid_layout.h"

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

struct Candidate {
    int cell;
    double fraction;
};

// The cell at a coordinate, and its neighbour where that lies on their border; the second cell is negative
// where there is none, the first one outside the grid.
struct Candidates {
    Candidate first{-1, 0};
    Candidate second{-1, 0};
};

// g counts cells; border cells of a map of centers are half as wide as the others and g begins with -1/2.
// What lies within `rounding` of a border lies on it.
Candidates candidatesAt(double g, double rounding, int cells, int border) {
    const double least = -0.5 * border, most = cells - 1.5 * border;
    if (!(g >= least - rounding && g <= most + rounding)) return {};
    const auto cellAt = [&](double coordinate) {
        return std::clamp(static_cast<int>(std::floor(coordinate)) + border, 0, cells - 1);
    };
    const auto candidate = [&](int cell) -> Candidate {
        const double begin = std::max(least, static_cast<double>(cell - border));
        const double end = std::min(most, static_cast<double>(cell - border + 1));
        return {cell, std::clamp((g - begin) / (end - begin), 0.0, 1.0)};
    };
    const int cell = cellAt(g), below = cellAt(g - rounding), above = cellAt(g + rounding);
    Candidates found;
    found.first = candidate(cell);
    if (below != above) found.second = candidate(below == cell ? above : below);
    return found;
}

}  // namespace

CellsAt GridLayout::cellsAt(glm::dvec2 px) const {
    constexpr double kRoundingPx = 1e-7;  // a tenth of what a position must come back to
    const glm::dvec2 g = px / cellPx_ - 0.5 * border_, rounding = kRoundingPx / cellPx_;
    const Candidates x = candidatesAt(g.x, rounding.x, cells().x, border_);
    const Candidates y = candidatesAt(g.y, rounding.y, cells().y, border_);
    CellsAt found;
    for (const Candidate& row : {y.first, y.second})
        for (const Candidate& column : {x.first, x.second})
            if (row.cell >= 0 && column.cell >= 0)
                found.add({{column.cell, row.cell}, {column.fraction, row.fraction}});
    return found;
}

}  // namespace curvewall
