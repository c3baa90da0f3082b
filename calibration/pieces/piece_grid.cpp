#include "calibration/pieces/piece_grid.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvewall {
namespace {

constexpr int kSteps = 128;  // along the direction that is cut
constexpr int kLines = 33;   // across it, both borders included

PieceVertex vertexOnSurface(const Projection& projection, glm::dvec2 px) {
    // A hole between the pixels that were looked at: the error is unknown there and the certificate decides.
    return {projection.unproject(px).value_or(glm::dvec3(std::numeric_limits<double>::quiet_NaN())), px};
}

// How far a chord from `from` to `to` is off half way, in pixels: the error of the narrow facet that has the
// chord as its edge.
double chordErrorPx(const Projection& projection, glm::dvec2 from, glm::dvec2 to, glm::dvec2 aside) {
    const glm::dmat3 h = homographyThrough(vertexOnSurface(projection, from), vertexOnSurface(projection, to),
                                           vertexOnSurface(projection, from + aside));
    const glm::dvec2 middle = 0.5 * (from + to);
    const glm::dvec3 seen = h * vertexOnSurface(projection, middle).m;
    return glm::length(glm::dvec2(seen) / seen.z - middle);
}

// Running sums of the square root of the largest chord error across each step along `axis`.
std::vector<double> bendAlong(const Projection& projection, glm::dvec2 sizePx, int axis) {
    glm::dvec2 step(0), line(0), aside(0);
    step[axis] = sizePx[axis] / kSteps;
    line[1 - axis] = sizePx[1 - axis] / (kLines - 1);
    // A pixel is half a turn on a small display, where the way aside would be in one plane with the eye.
    aside[1 - axis] = std::min(1.0, sizePx[1 - axis] / kSteps);
    std::vector<double> sums{0};
    for (int i = 0; i < kSteps; ++i) {
        double worst = 0;
        for (int j = 0; j < kLines; ++j) {
            const glm::dvec2 from = double(i) * step + double(j) * line;
            const double inward = j < kLines / 2 ? 1 : -1;
            worst = std::max(worst, chordErrorPx(projection, from, from + step, inward * aside));
        }
        sums.push_back(sums.back() + std::sqrt(worst));
    }
    return sums;
}

// `count` + 1 positions from 0 to `lengthPx` that share the bend equally. Straight displays share the length.
std::vector<double> equalShares(const std::vector<double>& bend, int count, double lengthPx) {
    const double floor =
        1e-3 * std::max(bend.back(), 1e-6) / kSteps;  // so that a straight stretch advances too
    const auto bendAt = [&](size_t i) { return bend[i] + floor * static_cast<double>(i); };
    std::vector<double> positions{0};
    size_t step = 0;
    for (int k = 1; k < count; ++k) {
        const double share = bendAt(kSteps) * k / count;
        while (bendAt(step + 1) < share) ++step;
        const double within = (share - bendAt(step)) / (bendAt(step + 1) - bendAt(step));
        positions.push_back(lengthPx * (static_cast<double>(step) + within) / kSteps);
    }
    positions.push_back(lengthPx);
    return positions;
}

}  // namespace

BendProfile::BendProfile(const Projection& projection, glm::ivec2 sizePx)
    : sizePx_(sizePx),
      columnBend_(bendAlong(projection, sizePx, 0)),
      rowBend_(bendAlong(projection, sizePx, 1)) {}

double BendProfile::columnsFor(double errorPx) const { return columnBend_.back() / std::sqrt(errorPx); }
double BendProfile::rowsFor(double errorPx) const { return rowBend_.back() / std::sqrt(errorPx); }

PieceGrid BendProfile::grid(const Projection& projection, int columns, int rows) const {
    const std::vector<double> x = equalShares(columnBend_, columns, sizePx_.x);
    const std::vector<double> y = equalShares(rowBend_, rows, sizePx_.y);
    PieceGrid grid{sizePx_, columns, rows, {}};
    for (double yPx : y)
        for (double xPx : x) grid.vertices.push_back(vertexOnSurface(projection, snapToGrid({xPx, yPx})));
    return grid;
}

}  // namespace curvewall
