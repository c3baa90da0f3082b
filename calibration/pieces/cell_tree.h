#pragma once
// A display cut into rectangles at whole pixels, coarse first and finer where that is asked for.

#include <glm/vec2.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace curvewall {

// The pixels from `fromPx` up to but not including `toPx`.
struct Cell {
    glm::ivec2 fromPx{0};
    glm::ivec2 toPx{0};

    glm::ivec2 sizePx() const { return toPx - fromPx; }
};

// Cells have numbers that stay theirs. Whole ones are the leaves of the tree.
class CellTree {
public:
    // Begins as columns x rows of nearly equal cells, as many as there are pixels at most.
    CellTree(glm::ivec2 sizePx, glm::ivec2 counts);

    const Cell& cell(uint32_t id) const { return nodes_[id].cell; }
    bool isWhole(uint32_t id) const { return nodes_[id].axis < 0; }
    uint32_t cellCount() const { return static_cast<uint32_t>(nodes_.size()); }  // whole or cut
    std::vector<uint32_t> wholeCells() const;

    // Cuts a whole cell in the middle, across the axis (0: into left and right). It must be two pixels wide
    // there. The halves are the last two cells.
    void cut(uint32_t id, int axis);

    // The whole cell that has the pixel, which must be on the display.
    uint32_t cellAt(glm::ivec2 px) const;

    glm::ivec2 sizePx() const { return sizePx_; }

private:
    struct Node {
        Cell cell;
        int axis = -1;           // that it was cut across
        uint32_t firstHalf = 0;  // of its two, which follow each other
    };

    glm::ivec2 sizePx_;
    std::vector<int> columnsPx_, rowsPx_;  // where the first cells begin
    std::vector<Node> nodes_;
};

// The two halves that a cut across the axis makes.
std::pair<Cell, Cell> halvesOf(const Cell& cell, int axis);

}  // namespace curvewall
