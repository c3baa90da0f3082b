#include "calibration/projections/grid_map.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <utility>

namespace curvewall {
namespace {

// What a perspective and the blend of four corners may round by, as a share of the largest number in them.
constexpr double kRounding = 1e-12;

}  // namespace

GridMap::GridMap(NumberMap numbers, const NodeMeaning& meaning, glm::ivec2 sizePx, Alignment alignment)
    : numbers_(std::move(numbers)),
      meaning_(meaning),
      layout_(numbers_.sizePx, sizePx, alignment),
      slackPx_(kRounding * std::max(sizePx.x, sizePx.y)),
      pyramid_(survey()) {}

glm::dvec2 GridMap::sample(glm::ivec2 line) const {
    const glm::ivec2 place = layout_.nodeAt(line);
    const float* number =
        numbers_.at(place.x, meaning_.bottomRowFirst ? numbers_.sizePx.y - 1 - place.y : place.y);
    glm::dvec2 value = meaning_.gain * glm::dvec2(number[0], number[1]) + meaning_.bias;
    value += meaning_.isOffset ? layout_.linePx(line) : layout_.beyondNodePx(line);
    if (std::abs(value.x) <= kFarthestPx && std::abs(value.y) <= kFarthestPx) return value;
    return glm::dvec2(std::numeric_limits<double>::quiet_NaN());
}

glm::dvec2 GridMap::node(glm::ivec2 line) const {
    if (meaning_.border == BorderCells::straight && layout_.hasBorder())
        return layout_.straightAt<glm::dvec2>(line, [this](glm::ivec2 l) { return sample(l); });
    return sample(line);
}

GridPyramid<2> GridMap::survey() {
    int64_t facing = 0;
    const auto visitNode = [&](glm::dvec2 value) { hasSamples_ = hasSamples_ || !std::isnan(value.x); };
    const auto visitCell = [&](glm::dvec2 v00, glm::dvec2 v10, glm::dvec2 v01, glm::dvec2 v11) {
        const double twiceArea = maths::cross2(v11 - v00, v01 - v10);
        facing += (twiceArea > 0) - (twiceArea < 0);
        hasArea_ = hasArea_ || !isHoleCell(v00, v10, v01, v11);
    };
    GridPyramid<2> pyramid(
        layout_.cells(), kRounding * kFarthestPx, [this](glm::ivec2 line) { return node(line); }, visitNode,
        visitCell);
    facing_ = facing < 0 ? -1 : 1;
    return pyramid;
}

std::optional<GridMap::Corners> GridMap::corners(glm::ivec2 cell) const {
    const Corners c{node(cell), node(cell + glm::ivec2(1, 0)), node(cell + glm::ivec2(0, 1)), node(cell + 1)};
    if (isHoleCell(c.v00, c.v10, c.v01, c.v11)) return std::nullopt;
    return c;
}

std::optional<glm::dvec2> GridMap::at(glm::dvec2 px) const {
    for (const auto& [cell, st] : layout_.cellsAt(px))
        if (const auto c = corners(cell))
            return maths::bilinearAt(maths::bilinearCell(c->v00, c->v10, c->v01, c->v11), st);
    return std::nullopt;
}

// found(CellPosition, determinant of the cell there)
template <class Found>
void GridMap::solve(glm::dvec2 value, const Found& found) const {
    const double slack = std::max(slackPx_, kRounding * largestCoordinate(value));
    pyramid_.forBlocks([value](const BoxTile<2>& tile) { return boxesAround(tile, glm::vec2(value)); },
                       [&](const CellBlock& block) {
                           solveBlock(
                               block, value, slack, [this](glm::ivec2 line) { return node(line); },
                               [&](glm::ivec2 cell, glm::dvec2 st, const maths::BilinearCell& blend) {
                                   if (corners(cell))
                                       found(CellPosition{cell, st}, maths::bilinearDeterminant(blend, st));
                               });
                       });
}

std::vector<glm::dvec2> GridMap::positions(glm::dvec2 value) const {
    std::vector<glm::dvec2> positions;
    solve(value,
          [&](const CellPosition& p, double /*determinant*/) { addIfNew(positions, layout_.positionPx(p)); });
    return positions;
}

std::optional<glm::dvec2> GridMap::frontPosition(glm::dvec2 value) const {
    using Rank = std::tuple<bool, int, int>;
    std::optional<std::pair<Rank, CellPosition>> best;
    solve(value, [&](const CellPosition& p, double determinant) {
        const Rank rank{determinant * facing_ <= 0, p.cell.y, p.cell.x};
        if (!best || rank < best->first) best = {rank, p};
    });
    if (!best) return std::nullopt;
    return layout_.positionPx(best->second);
}

void addIfNew(std::vector<glm::dvec2>& positions, glm::dvec2 px) {
    const auto same = [px](glm::dvec2 other) { return glm::distance(px, other) < kSamePositionPx; };
    if (std::ranges::none_of(positions, same)) positions.push_back(px);
}

}  // namespace curvewall
