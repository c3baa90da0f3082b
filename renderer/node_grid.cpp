#include "renderer/node_grid.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace curvewall {
namespace {

// Of 75 degrees: beyond, a plane stretches until its cells mean nothing.
constexpr double kLeastAheadCosine = 0.2588;

// More than what single precision rounds off places on a plane.
constexpr double kRoundingSlack = 2e-5;

// Cells smaller than pieces tell more about a small sphere. The largest grid takes 700 KiB a plane.
constexpr size_t kCellsPerPiece = 4;
constexpr unsigned kLeastWidth = 32, kMostWidth = 256;

using Rays = std::vector<glm::dvec3>;

void include(NodeRange& range, NodeRange other) {
    range = {std::min(range.x, other.x), std::max(range.y, other.y)};
}

GridPlane planeBetween(const GridPlane& axes, glm::dvec2 least, glm::dvec2 most, int width) {
    GridPlane plane = axes;
    plane.least = least - kRoundingSlack;
    plane.cellsPerUnit = static_cast<double>(width) / (most - least + 2 * kRoundingSlack);
    return plane;
}

// A leaf's guarded piece in the axes right, down and ahead of a plane.
struct LeafOnPlane {
    Rays corners, edges;
};

class GridBuilder {
public:
    GridBuilder(const PieceMesh& mesh, double guardPx) {
        for (const Piece& piece : mesh.pieces) {
            corners_.push_back(guardedCorners(mesh, piece, guardPx));
            for (glm::dvec3& corner : corners_.back()) corner = glm::normalize(corner);
            edges_.push_back(edgePlanes(mesh, piece, guardPx));
        }
    }

    NodeGrid build(std::span<const ConeNode> tree) {
        for (const GridPlane& plane : layPlanes()) {
            std::vector<NodeRange> finest(static_cast<size_t>(grid_.width) * static_cast<size_t>(grid_.width),
                                          kNoNodes);
            bool isTouched = false;
            for (size_t i = 0; i < tree.size(); ++i) {
                if (tree[i].piece < 0) continue;
                const auto node = static_cast<uint32_t>(i);
                isTouched |= addLeaf(finest, plane, static_cast<size_t>(tree[i].piece), {node, node + 1});
            }
            if (!isTouched) continue;
            grid_.planes.push_back(plane);
            addLevels(std::move(finest));
        }
        return std::move(grid_);
    }

private:
    std::vector<GridPlane> layPlanes() {
        const GridPlane axes = middleAxes();
        glm::dvec2 least(std::numeric_limits<double>::infinity()), most(-least);
        bool isNarrow = true;
        for (const Rays& corners : corners_)
            for (const glm::dvec3& corner : corners) {
                const double ahead = glm::dot(corner, axes.ahead);
                const glm::dvec2 place(glm::dot(corner, axes.right), glm::dot(corner, axes.down));
                isNarrow = isNarrow && ahead >= kLeastAheadCosine;
                least = glm::min(least, place / ahead);
                most = glm::max(most, place / ahead);
            }
        grid_.width = widthFor(isNarrow ? 1 : kMostGridPlanes);
        if (isNarrow) return {planeBetween(axes, least, most, grid_.width)};
        std::vector<GridPlane> sides;
        for (const double sign : {1.0, -1.0})
            for (const GridPlane& side : {GridPlane{axes.right, axes.down, sign * axes.ahead, {}, {}},
                                          GridPlane{axes.down, axes.ahead, sign * axes.right, {}, {}},
                                          GridPlane{axes.ahead, axes.right, sign * axes.down, {}, {}}})
                sides.push_back(planeBetween(side, glm::dvec2(-1), glm::dvec2(1), grid_.width));
        return sides;
    }

    GridPlane middleAxes() const {
        glm::dvec3 sum(0);
        for (const Rays& corners : corners_)
            for (const glm::dvec3& corner : corners) sum += corner;
        GridPlane axes;
        // All around the eye any direction will do.
        axes.ahead = glm::length(sum) > 1e-9 ? glm::normalize(sum) : glm::dvec3(0, 0, -1);
        const glm::dvec3 helper = std::abs(axes.ahead.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        axes.right = glm::normalize(glm::cross(axes.ahead, helper));
        axes.down = glm::cross(axes.ahead, axes.right);
        return axes;
    }

    int widthFor(size_t planes) const {
        const size_t cells = kCellsPerPiece * corners_.size() / planes;
        return static_cast<int>(std::bit_ceil(std::clamp(
            static_cast<unsigned>(std::sqrt(static_cast<double>(cells))), kLeastWidth, kMostWidth)));
    }

    // Whether it lies over any cell.
    bool addLeaf(std::vector<NodeRange>& finest, const GridPlane& plane, size_t piece, NodeRange node) const {
        const glm::dmat3 planeFromWall = glm::transpose(glm::dmat3(plane.right, plane.down, plane.ahead));
        LeafOnPlane leaf;
        for (const glm::dvec3& corner : corners_[piece]) leaf.corners.push_back(planeFromWall * corner);
        for (const glm::dvec3& edge : edges_[piece]) leaf.edges.push_back(planeFromWall * edge);
        return addWithin(finest, plane, leaf, node, 1, {0, 0});
    }

    // Within a cell of the level that has `width` of them a side.
    bool addWithin(std::vector<NodeRange>& finest, const GridPlane& plane, const LeafOnPlane& leaf,
                   NodeRange node, int width, glm::ivec2 cell) const {
        const glm::dvec2 side =
            static_cast<double>(grid_.width) / static_cast<double>(width) / plane.cellsPerUnit;
        const glm::dvec2 least = plane.least + glm::dvec2(cell) * side;
        if (!mayTouch(leaf, least - kRoundingSlack, least + side + kRoundingSlack)) return false;
        if (width == grid_.width) {
            include(finest[static_cast<size_t>(cell.y) * static_cast<size_t>(width) +
                           static_cast<size_t>(cell.x)],
                    node);
            return true;
        }
        bool isTouched = false;
        for (const glm::ivec2 child : {glm::ivec2(0, 0), {1, 0}, {0, 1}, {1, 1}})
            isTouched |= addWithin(finest, plane, leaf, node, 2 * width, 2 * cell + child);
        return isTouched;
    }

    // Not where a plane through the eye and a side of either has all of the other behind it.
    static bool mayTouch(const LeafOnPlane& leaf, glm::dvec2 least, glm::dvec2 most) {
        for (const glm::dvec3& edge : leaf.edges) {
            const glm::dvec2 farthest(edge.x > 0 ? most.x : least.x, edge.y > 0 ? most.y : least.y);
            if (glm::dot(edge, glm::dvec3(farthest, 1)) < 0) return false;
        }
        for (const glm::dvec3& side : {glm::dvec3(1, 0, -least.x), glm::dvec3(-1, 0, most.x),
                                       glm::dvec3(0, 1, -least.y), glm::dvec3(0, -1, most.y)})
            if (std::ranges::all_of(leaf.corners, [&](glm::dvec3 c) { return glm::dot(side, c) < 0; }))
                return false;
        return true;
    }

    void addLevels(std::vector<NodeRange> level) {
        grid_.ranges.insert(grid_.ranges.end(), level.begin(), level.end());
        for (auto width = static_cast<size_t>(grid_.width) / 2; width > 0; width /= 2) {
            std::vector<NodeRange> coarser(width * width, kNoNodes);
            for (size_t y = 0; y < 2 * width; ++y)
                for (size_t x = 0; x < 2 * width; ++x)
                    include(coarser[y / 2 * width + x / 2], level[y * 2 * width + x]);
            grid_.ranges.insert(grid_.ranges.end(), coarser.begin(), coarser.end());
            level = std::move(coarser);
        }
    }

    std::vector<Rays> corners_, edges_;  // of each piece; corners of length one
    NodeGrid grid_;
};

}  // namespace

NodeGrid buildNodeGrid(const PieceMesh& mesh, std::span<const ConeNode> tree, double guardPx) {
    return GridBuilder(mesh, guardPx).build(tree);
}

NodeRange nodesUnder(const NodeGrid& grid, glm::dvec3 centre, double radius) {
    NodeRange touched = kNoNodes;
    for (size_t i = 0; i < grid.planes.size(); ++i) {
        const GridPlane& plane = grid.planes[i];
        const maths::BoxBounds box =
            maths::sphereBoxBounds(centre, radius, plane.right, plane.down, plane.ahead, 0);
        const maths::GridCells cells =
            maths::gridCellsUnder(box, plane.least, plane.cellsPerUnit, grid.width);
        const auto first = i * static_cast<size_t>(cellsOfPlane(grid.width));
        for (int y = cells.first.y; y <= cells.last.y; ++y)
            for (int x = cells.first.x; x <= cells.last.x; ++x)
                include(touched,
                        grid.ranges[first + static_cast<size_t>(cells.offset + y * cells.width + x)]);
    }
    return touched;
}

}  // namespace curvewall
