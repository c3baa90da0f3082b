#pragma once
// Where the nodes of a measured grid lie on the rectangle that it covers.

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include <array>

namespace curvewall {

enum class Alignment {
    centers,  // node i of n at (i + 1/2) / n, as texels lie in a texture
    corners,  // node i of n at i / (n - 1)
};

struct CellPosition {
    glm::ivec2 cell;
    glm::dvec2 st;  // within the cell, 0 to 1
};

// The cells that hold a position: one; those that touch it to rounding on their common border; none outside.
class CellsAt {
public:
    const CellPosition* begin() const { return cells_.data(); }
    const CellPosition* end() const { return cells_.data() + count_; }
    void add(const CellPosition& position) { cells_[static_cast<size_t>(count_++)] = position; }

private:
    std::array<CellPosition, 4> cells_{};
    int count_ = 0;
};

// Lines in x and y cut the rectangle into cells. Every line carries nodes; with centers the rectangle's
// border adds a line on each side, which has no nodes of its own.
class GridLayout {
public:
    GridLayout(glm::ivec2 nodes, glm::dvec2 sizePx, Alignment alignment)
        : nodes_(nodes),
          sizePx_(sizePx),
          border_(alignment == Alignment::centers ? 1 : 0),
          cellPx_(sizePx / glm::dvec2(border_ == 1 ? nodes : nodes - 1)) {}

    glm::ivec2 lines() const { return nodes_ + 2 * border_; }
    glm::ivec2 cells() const { return lines() - 1; }
    glm::dvec2 sizePx() const { return sizePx_; }
    bool hasBorder() const { return border_ == 1; }

    // The node on the line, or the nearest one.
    glm::ivec2 nodeAt(glm::ivec2 line) const { return glm::clamp(line - border_, glm::ivec2(0), nodes_ - 1); }

    glm::dvec2 linePx(glm::ivec2 line) const {
        return glm::clamp((glm::dvec2(line) - 0.5 * border_) * cellPx_, glm::dvec2(0), sizePx_);
    }

    // How far beyond the nearest node a line lies; zero where the node is on it.
    glm::dvec2 beyondNodePx(glm::ivec2 line) const { return linePx(line) - linePx(nodeAt(line) + border_); }

    // The value on a line of a map of centers whose border cells go on straight: beyond the outermost nodes
    // half a cell further along the line through the two last ones.
    template <class Vector, class Sample>
    Vector straightAt(glm::ivec2 line, const Sample& sample) const {
        const glm::ivec2 last = lines() - 1;
        for (int axis = 0; axis < 2; ++axis) {
            if (line[axis] != 0 && line[axis] != last[axis]) continue;
            glm::ivec2 step(0);
            step[axis] = line[axis] == 0 ? 1 : -1;
            return 1.5 * straightAt<Vector>(line + step, sample) -
                   0.5 * straightAt<Vector>(line + 2 * step, sample);
        }
        return sample(line);
    }

    glm::dvec2 positionPx(const CellPosition& p) const {
        return glm::mix(linePx(p.cell), linePx(p.cell + 1), p.st);
    }

    CellsAt cellsAt(glm::dvec2 px) const;

private:
    glm::ivec2 nodes_;
    glm::dvec2 sizePx_;
    int border_;
    glm::dvec2 cellPx_;
};

}  // namespace curvewall
