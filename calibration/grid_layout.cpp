#include "calibration/grid_layout.h"

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

struct Candidate {
    int cell;
    double fraction;
};

// The cell at coordinate g, and its neighbour where g is on their border to rounding; the second cell is
// negative where there is none, the first one outside the grid.
struct Candidates {
    Candidate first{-1, 0};
    Candidate second{-1, 0};
};

// g counts cells; border cells of a map of centers are half as wide as the others and g counts them from
// -1/2.
Candidates candidatesAt(double g, int cells, int border) {
    constexpr double kOnBorder = 1e-9;
    const double least = -0.5 * border, most = cells - 1.5 * border;
    if (!(g >= least - kOnBorder && g <= most + kOnBorder)) return {};
    const auto cellAt = [&](double coordinate) {
        return std::clamp(static_cast<int>(std::floor(coordinate)) + border, 0, cells - 1);
    };
    const auto candidate = [&](int cell) -> Candidate {
        const double begin = std::max(least, static_cast<double>(cell - border));
        const double end = std::min(most, static_cast<double>(cell - border + 1));
        return {cell, (g - begin) / (end - begin)};
    };
    const int cell = cellAt(g), below = cellAt(g - kOnBorder), above = cellAt(g + kOnBorder);
    Candidates found{candidate(cell), {}};
    if (below != above) found.second = candidate(below == cell ? above : below);
    return found;
}

}  // namespace

CellsAt GridLayout::cellsAt(glm::dvec2 px) const {
    const glm::dvec2 g =
        border_ == 0 ? px / sizePx_ * glm::dvec2(nodes_ - 1) : px / sizePx_ * glm::dvec2(nodes_) - 0.5;
    const Candidates x = candidatesAt(g.x, cells().x, border_), y = candidatesAt(g.y, cells().y, border_);
    CellsAt found;
    for (const Candidate& row : {y.first, y.second})
        for (const Candidate& column : {x.first, x.second})
            if (row.cell >= 0 && column.cell >= 0)
                found.add({{column.cell, row.cell}, {column.fraction, row.fraction}});
    return found;
}

}  // namespace curvewall
