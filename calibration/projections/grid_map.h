#pragma once
// A measured map of a rectangle into a plane: values at the nodes of a grid, bilinear between them, and all
// that it maps to a given value. The paper's camera texture (Lorenz and Doellner 2009, section 3.2) is one.

#include "calibration/files/map_file.h"
#include "calibration/projections/grid_layout.h"
#include "calibration/projections/grid_pyramid.h"

#include <glm/vec2.hpp>

#include <optional>
#include <vector>

namespace curvewall {

// How a map of centers goes on from its outermost nodes to the border of the rectangle, half a cell further.
enum class BorderCells {
    sameOffset,  // the offset from the position stays as it is, as in a clamped texture of offsets
    straight,    // as the cells beside them do: values that are positions would be off by half a cell else
};

// What the numbers of a file mean: value = gain * number + bias, in pixels, x right and y down.
struct NodeMeaning {
    glm::dvec2 gain{1};
    glm::dvec2 bias{0};
    bool isOffset = false;  // the value is relative to where its node lies
    bool bottomRowFirst = false;
    BorderCells border = BorderCells::sameOffset;  // straight needs 2 x 2 nodes
};

// A value farther away than this is not taken for a measurement: between such a node and its neighbours
// double precision no longer keeps a pixel to 1e-6.
inline constexpr double kFarthestPx = 1e5;

// Cells with a node that is no sample (not a number, infinite, beyond kFarthestPx) and cells without area are
// holes.
class GridMap {
public:
    // Uses the first two channels. With `corners` there must be 2 x 2 nodes.
    GridMap(NumberMap numbers, const NodeMeaning& meaning, glm::ivec2 sizePx, Alignment alignment);

    glm::dvec2 sizePx() const { return layout_.sizePx(); }

    bool hasSamples() const { return hasSamples_; }
    bool hasArea() const { return hasArea_; }  // at least one cell is no hole

    // The value at a position; nothing in holes and outside the rectangle.
    std::optional<glm::dvec2> at(glm::dvec2 px) const;

    // Every position with the value.
    std::vector<glm::dvec2> positions(glm::dvec2 value) const;

    // One of them where the map folds: on a side that faces as most cells do, if there is any, and there in
    // the topmost and then leftmost cell.
    std::optional<glm::dvec2> frontPosition(glm::dvec2 value) const;

private:
    struct Corners {
        glm::dvec2 v00, v10, v01, v11;
    };
    glm::dvec2 sample(glm::ivec2 line) const;
    glm::dvec2 node(glm::ivec2 line) const;
    std::optional<Corners> corners(glm::ivec2 cell) const;  // nothing for a hole
    GridPyramid<2> survey();
    template <class Found>
    void solve(glm::dvec2 value, const Found& found) const;

    NumberMap numbers_;
    NodeMeaning meaning_;
    GridLayout layout_;
    double slackPx_;
    bool hasSamples_ = false;
    bool hasArea_ = false;
    double facing_ = 1;       // the sign of most cells' determinants
    GridPyramid<2> pyramid_;  // last: the walk that builds it finds out the members before
};

// Positions nearer than this to one another are one answer, found in two cells on their common border.
inline constexpr double kSamePositionPx = 5e-7;

void addIfNew(std::vector<glm::dvec2>& positions, glm::dvec2 px);

}  // namespace curvewall
