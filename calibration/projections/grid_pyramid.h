#pragma once
// Finds cells of a grid by the values at their nodes: boxes around the values of blocks of cells, boxes
// around four boxes, and so on up to one. Takes little more than a byte for each cell and axis pair.

#include "calibration/projections/bilinear_cell.h"

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace curvewall {

template <int N>
struct ValueBox {
    glm::vec<N, float> low{std::numeric_limits<float>::infinity()};
    glm::vec<N, float> high{-std::numeric_limits<float>::infinity()};

    bool isEmpty() const { return low.x > high.x; }
};

// Four by four neighbours' boxes, axis by axis, so that one test serves them all.
template <int N>
struct BoxTile {
    static constexpr int kSide = 4;
    static constexpr int kBoxes = kSide * kSide;
    std::array<std::array<float, kBoxes>, N> low, high;

    BoxTile() {
        for (auto& axis : low) axis.fill(std::numeric_limits<float>::infinity());
        for (auto& axis : high) axis.fill(-std::numeric_limits<float>::infinity());
    }
    void set(size_t i, const ValueBox<N>& box) {
        for (int axis = 0; axis < N; ++axis) {
            low[static_cast<size_t>(axis)][i] = box.low[axis];
            high[static_cast<size_t>(axis)][i] = box.high[axis];
        }
    }
    ValueBox<N> whole() const {
        ValueBox<N> box;
        for (int axis = 0; axis < N; ++axis) {
            box.low[axis] = *std::ranges::min_element(low[static_cast<size_t>(axis)]);
            box.high[axis] = *std::ranges::max_element(high[static_cast<size_t>(axis)]);
        }
        return box;
    }
};

// Bit i stands for box i of a tile.
using TileMask = uint32_t;

// The boxes that hold a value of the plane. Without branches, and with the bits from a table: compilers make
// four tests at once of it.
inline TileMask boxesAround(const BoxTile<2>& tile, glm::vec2 value) {
    static constexpr std::array<int32_t, BoxTile<2>::kBoxes> kBits = [] {
        std::array<int32_t, BoxTile<2>::kBoxes> bits{};
        for (size_t i = 0; i < bits.size(); ++i) bits[i] = 1 << i;
        return bits;
    }();
    int32_t mask = 0;
    for (size_t i = 0; i < kBits.size(); ++i)
        mask |= (value.x >= tile.low[0][i] ? kBits[i] : 0) & (value.x <= tile.high[0][i] ? kBits[i] : 0) &
                (value.y >= tile.low[1][i] ? kBits[i] : 0) & (value.y <= tile.high[1][i] ? kBits[i] : 0);
    return static_cast<TileMask>(mask);
}

// Cells from `begin` to before `end`.
struct CellBlock {
    glm::ivec2 begin;
    glm::ivec2 end;
};

template <int N>
class GridPyramid {
public:
    static constexpr int kBlock = 4;  // cells on each side of a block
    using Value = glm::vec<N, double>;

    // node(line) is the value where two lines cross; one that is not a number counts for nothing. Boxes are
    // wider than the values by `slack` at least, and by more than rounding a value to float. The walk that
    // finds the boxes shows visitNode(value) every node and visitCell(v00, v10, v01, v11) every cell.
    template <class Node, class VisitNode, class VisitCell>
    GridPyramid(glm::ivec2 cells, double slack, const Node& node, const VisitNode& visitNode,
                const VisitCell& visitCell)
        : cells_(cells) {
        const glm::ivec2 blocks = (cells + kBlock - 1) / kBlock;
        levels_.push_back(emptyLevel(blocks));
        std::vector<std::vector<Value>> rows(kBlock + 1,
                                             std::vector<Value>(static_cast<size_t>(cells.x) + 1));
        const auto readRow = [&](std::vector<Value>& row, int y) {
            for (int x = 0; x <= cells.x; ++x) {
                row[static_cast<size_t>(x)] = node(glm::ivec2(x, y));
                visitNode(row[static_cast<size_t>(x)]);
            }
        };
        readRow(rows.back(), 0);
        for (int y = 0; y < blocks.y; ++y) {
            const int height = std::min(kBlock, cells.y - y * kBlock);
            std::swap(rows.front(), rows.back());
            for (int i = 1; i <= height; ++i) {
                readRow(rows[static_cast<size_t>(i)], y * kBlock + i);
                visitRow(rows[static_cast<size_t>(i) - 1], rows[static_cast<size_t>(i)], visitCell);
            }
            for (int x = 0; x < blocks.x; ++x) {
                const int width = std::min(kBlock, cells.x - x * kBlock);
                levels_.back().set({x, y},
                                   boxOf(rows, static_cast<size_t>(x) * kBlock, {width, height}, slack));
            }
        }
        while (levels_.back().tiles.size() > 1) levels_.push_back(parentsOf(levels_.back()));
    }

    // visit(block) for every block whose box, and each box around it, is in the mask touched(tile).
    template <class Touched, class Visit>
    void forBlocks(const Touched& touched, const Visit& visit) const {
        descend(levels_.size() - 1, {0, 0}, touched, visit);
    }

private:
    using Tile = BoxTile<N>;
    static constexpr int kSide = Tile::kSide;

    struct Level {
        glm::ivec2 tileCount;
        std::vector<Tile> tiles;

        void set(glm::ivec2 place, const ValueBox<N>& box) {
            const glm::ivec2 within = place % kSide;
            tiles[index(place / kSide)].set(
                static_cast<size_t>(within.y) * kSide + static_cast<size_t>(within.x), box);
        }
        const Tile& at(glm::ivec2 tile) const { return tiles[index(tile)]; }
        size_t index(glm::ivec2 tile) const {
            return static_cast<size_t>(tile.y) * static_cast<size_t>(tileCount.x) +
                   static_cast<size_t>(tile.x);
        }
    };

    static Level emptyLevel(glm::ivec2 boxes) {
        const glm::ivec2 tiles = (boxes + kSide - 1) / kSide;
        return {tiles, std::vector<Tile>(static_cast<size_t>(tiles.x) * static_cast<size_t>(tiles.y))};
    }

    static Level parentsOf(const Level& children) {
        Level parents = emptyLevel(children.tileCount);
        for (int y = 0; y < children.tileCount.y; ++y)
            for (int x = 0; x < children.tileCount.x; ++x) parents.set({x, y}, children.at({x, y}).whole());
        return parents;
    }

    template <class VisitCell>
    static void visitRow(const std::vector<Value>& above, const std::vector<Value>& row,
                         const VisitCell& visitCell) {
        for (size_t x = 0; x + 1 < row.size(); ++x) visitCell(above[x], above[x + 1], row[x], row[x + 1]);
    }

    static ValueBox<N> boxOf(const std::vector<std::vector<Value>>& rows, size_t begin, glm::ivec2 cells,
                             double slack) {
        Value low(std::numeric_limits<double>::infinity()), high(-low);
        for (int y = 0; y <= cells.y; ++y) {
            const Value* row = &rows[static_cast<size_t>(y)][begin];
            for (int x = 0; x <= cells.x; ++x) {
                low = glm::min(low, row[x]);  // keeps its first argument beside one that is not a number
                high = glm::max(high, row[x]);
            }
        }
        if (low.x > high.x) return {};
        const Value pad = slack + 2e-7 * glm::max(glm::abs(low), glm::abs(high));
        return {glm::vec<N, float>(low - pad), glm::vec<N, float>(high + pad)};
    }

    template <class Touched, class Visit>
    void descend(size_t level, glm::ivec2 tile, const Touched& touched, const Visit& visit) const {
        for (TileMask mask = touched(levels_[level].at(tile)); mask != 0; mask &= mask - 1) {
            const int i = std::countr_zero(mask);
            const glm::ivec2 place = tile * kSide + glm::ivec2(i % kSide, i / kSide);
            if (level > 0)
                descend(level - 1, place, touched, visit);
            else
                visit(CellBlock{place * kBlock, glm::min(cells_, (place + 1) * kBlock)});
        }
    }

    glm::ivec2 cells_;
    std::vector<Level> levels_;  // blocks first, one tile last
};

// Calls found(cell, st, corners' blend) for every point of the block that has the value to within `slack`,
// for nodes in a plane.
template <class Node, class Found>
void solveBlock(const CellBlock& block, glm::dvec2 value, double slack, const Node& node,
                const Found& found) {
    constexpr size_t kLines = GridPyramid<2>::kBlock + 1;
    std::array<std::array<glm::dvec2, kLines>, kLines> nodes;
    const auto columns = static_cast<size_t>(block.end.x - block.begin.x);
    const auto rows = static_cast<size_t>(block.end.y - block.begin.y);
    for (size_t y = 0; y <= rows; ++y)
        for (size_t x = 0; x <= columns; ++x) nodes[y][x] = node(block.begin + glm::ivec2(x, y));
    for (size_t y = 0; y < rows; ++y)
        for (size_t x = 0; x < columns; ++x) {
            const glm::dvec2 v00 = nodes[y][x], v10 = nodes[y][x + 1];
            const glm::dvec2 v01 = nodes[y + 1][x], v11 = nodes[y + 1][x + 1];
            const glm::dvec2 low = glm::min(glm::min(v00, v10), glm::min(v01, v11));
            const glm::dvec2 high = glm::max(glm::max(v00, v10), glm::max(v01, v11));
            if (glm::any(glm::lessThan(value, low - slack)) ||
                glm::any(glm::greaterThan(value, high + slack)))
                continue;
            const maths::BilinearCell cell = maths::bilinearCell(v00, v10, v01, v11);
            solveCell(cell, CellShape::quadrilateral, value, slack,
                      [&](glm::dvec2 st) { found(block.begin + glm::ivec2(x, y), st, cell); });
        }
}

}  // namespace curvewall
