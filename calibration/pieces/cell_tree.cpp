#include "calibration/pieces/cell_tree.h"

#include <algorithm>

namespace curvewall {
namespace {

// Where `count` nearly equal parts of `lengthPx` begin, and their end.
std::vector<int> equalParts(int lengthPx, int count) {
    std::vector<int> positions;
    for (int i = 0; i <= count; ++i)
        positions.push_back(static_cast<int>((int64_t{lengthPx} * i + count / 2) / count));
    return positions;
}

size_t partAt(const std::vector<int>& positions, int px) {
    return static_cast<size_t>(std::ranges::upper_bound(positions, px) - positions.begin()) - 1;
}

}  // namespace

CellTree::CellTree(glm::ivec2 sizePx, glm::ivec2 counts)
    : sizePx_(sizePx),
      columnsPx_(equalParts(sizePx.x, std::min(counts.x, sizePx.x))),
      rowsPx_(equalParts(sizePx.y, std::min(counts.y, sizePx.y))) {
    for (size_t row = 0; row + 1 < rowsPx_.size(); ++row)
        for (size_t column = 0; column + 1 < columnsPx_.size(); ++column)
            nodes_.push_back(
                {{{columnsPx_[column], rowsPx_[row]}, {columnsPx_[column + 1], rowsPx_[row + 1]}}});
}

std::vector<uint32_t> CellTree::wholeCells() const {
    std::vector<uint32_t> whole;
    for (uint32_t id = 0; id < cellCount(); ++id)
        if (isWhole(id)) whole.push_back(id);
    return whole;
}

void CellTree::cut(uint32_t id, int axis) {
    const auto [first, second] = halvesOf(nodes_[id].cell, axis);
    nodes_[id].axis = axis;
    nodes_[id].firstHalf = cellCount();
    nodes_.push_back({first});
    nodes_.push_back({second});
}

uint32_t CellTree::cellAt(glm::ivec2 px) const {
    size_t id = partAt(rowsPx_, px.y) * (columnsPx_.size() - 1) + partAt(columnsPx_, px.x);
    while (nodes_[id].axis >= 0) {
        const Node& node = nodes_[id];
        const int middlePx = nodes_[node.firstHalf].cell.toPx[node.axis];
        id = node.firstHalf + (px[node.axis] >= middlePx ? 1 : 0);
    }
    return static_cast<uint32_t>(id);
}

std::pair<Cell, Cell> halvesOf(const Cell& cell, int axis) {
    Cell first = cell, second = cell;
    first.toPx[axis] = second.fromPx[axis] = cell.fromPx[axis] + cell.sizePx()[axis] / 2;
    return {first, second};
}

}  // namespace curvewall
