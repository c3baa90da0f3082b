#include "renderer/node_grid.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace curvewall {
namespace {

constexpr double kLeastAheadCosine = 0.2588;  // of 75 degrees

// More than what single precision rounds off places on the plane.
constexpr double kRoundingSlack = 2e-5;

// Cells smaller than pieces tell more about a small sphere. The largest grid takes 700 KiB with all levels.
constexpr size_t kCellsPerPiece = 4;
constexpr unsigned kLeastWidth = 32, kMostWidth = 256;

struct Box {
    glm::dvec2 least{std::numeric_limits<double>::infinity()};
    glm::dvec2 most{-std::numeric_limits<double>::infinity()};

    void add(glm::dvec2 p) {
        least = glm::min(least, p);
        most = glm::max(most, p);
    }
};

class GridBuilder {
public:
    GridBuilder(const PieceMesh& mesh, double guardPx) : mesh_(mesh), guardPx_(guardPx) {}

    std::optional<NodeGrid> build(std::span<const ConeNode> tree) {
        if (!findPlane()) return std::nullopt;
        layCells();
        for (size_t i = 0; i < tree.size(); ++i)
            if (tree[i].piece >= 0) addLeaf(static_cast<uint32_t>(i), static_cast<size_t>(tree[i].piece));
        addCoarserLevels();
        return std::move(grid_);
    }

private:
    bool findPlane() {
        std::vector<std::vector<glm::dvec3>> rays;
        glm::dvec3 sum(0);
        for (const Piece& piece : mesh_.pieces) {
            std::vector<glm::dvec3>& corners = rays.emplace_back(guardedCorners(mesh_, piece, guardPx_));
            for (glm::dvec3& corner : corners) sum += corner = glm::normalize(corner);
        }
        if (!(glm::length(sum) > 0)) return false;
        grid_.ahead = glm::normalize(sum);
        const glm::dvec3 helper = std::abs(grid_.ahead.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        grid_.right = glm::normalize(glm::cross(grid_.ahead, helper));
        grid_.down = glm::cross(grid_.ahead, grid_.right);
        for (const std::vector<glm::dvec3>& corners : rays) {
            Box& box = boxes_.emplace_back();
            for (const glm::dvec3& corner : corners) {
                const double ahead = glm::dot(corner, grid_.ahead);
                if (!(ahead >= kLeastAheadCosine)) return false;
                box.add(glm::dvec2(glm::dot(corner, grid_.right), glm::dot(corner, grid_.down)) / ahead);
            }
        }
        return true;
    }

    void layCells() {
        Box all;
        for (Box& box : boxes_) {
            box = {box.least - kRoundingSlack, box.most + kRoundingSlack};
            all.add(box.least);
            all.add(box.most);
        }
        const auto wished =
            static_cast<unsigned>(std::sqrt(static_cast<double>(kCellsPerPiece * mesh_.pieces.size())));
        const unsigned width = std::bit_ceil(std::clamp(wished, kLeastWidth, kMostWidth));
        grid_.width = static_cast<int>(width);
        grid_.least = all.least;
        grid_.cellsPerUnit = static_cast<double>(width) / (all.most - all.least);
        grid_.ranges.assign(size_t{width} * width, kNoNodes);
    }

    int cellOf(double place, int axis) const {
        return std::clamp(static_cast<int>((place - grid_.least[axis]) * grid_.cellsPerUnit[axis]), 0,
                          grid_.width - 1);
    }

    void addLeaf(uint32_t node, size_t piece) {
        const std::vector<glm::dvec3> planes = edgePlanes(mesh_, mesh_.pieces[piece], guardPx_);
        const Box& box = boxes_[piece];
        for (int y = cellOf(box.least.y, 1); y <= cellOf(box.most.y, 1); ++y)
            for (int x = cellOf(box.least.x, 0); x <= cellOf(box.most.x, 0); ++x)
                if (mayTouch(planes, x, y)) {
                    NodeRange& range = grid_.ranges[static_cast<size_t>(y * grid_.width + x)];
                    range = {std::min(range.x, node), std::max(range.y, node + 1)};
                }
    }

    // Not where an edge of the piece has the whole cell behind it.
    bool mayTouch(const std::vector<glm::dvec3>& planes, int x, int y) const {
        const glm::dvec2 least = grid_.least + glm::dvec2(x, y) / grid_.cellsPerUnit - kRoundingSlack;
        const glm::dvec2 most = grid_.least + glm::dvec2(x + 1, y + 1) / grid_.cellsPerUnit + kRoundingSlack;
        return std::ranges::all_of(planes, [&](glm::dvec3 plane) {
            const glm::dvec2 slope(glm::dot(plane, grid_.right), glm::dot(plane, grid_.down));
            const glm::dvec2 farthest(slope.x > 0 ? most.x : least.x, slope.y > 0 ? most.y : least.y);
            return glm::dot(slope, farthest) + glm::dot(plane, grid_.ahead) >= 0;
        });
    }

    void addCoarserLevels() {
        size_t finer = 0;
        for (size_t width = static_cast<size_t>(grid_.width) / 2; width > 0; width /= 2) {
            const size_t next = grid_.ranges.size();
            for (size_t y = 0; y < width; ++y)
                for (size_t x = 0; x < width; ++x) {
                    NodeRange range = kNoNodes;
                    for (const size_t row : {2 * y, 2 * y + 1})
                        for (const size_t column : {2 * x, 2 * x + 1}) {
                            const NodeRange& cell = grid_.ranges[finer + row * 2 * width + column];
                            range = {std::min(range.x, cell.x), std::max(range.y, cell.y)};
                        }
                    grid_.ranges.push_back(range);
                }
            finer = next;
        }
    }

    const PieceMesh& mesh_;
    double guardPx_;
    NodeGrid grid_;
    std::vector<Box> boxes_;  // of each piece
};

}  // namespace

std::optional<NodeGrid> buildNodeGrid(const PieceMesh& mesh, std::span<const ConeNode> tree, double guardPx) {
    return GridBuilder(mesh, guardPx).build(tree);
}

NodeRange nodesUnder(const NodeGrid& grid, glm::dvec3 centre, double radius) {
    const maths::BoxBounds box = maths::sphereBoxBounds(centre, radius, grid.right, grid.down, grid.ahead, 0);
    const maths::GridCells cells = maths::gridCellsUnder(box, grid.least, grid.cellsPerUnit, grid.width);
    NodeRange touched = kNoNodes;
    for (int y = cells.first.y; y <= cells.last.y; ++y)
        for (int x = cells.first.x; x <= cells.last.x; ++x) {
            const NodeRange& range = grid.ranges[static_cast<size_t>(cells.offset + y * cells.width + x)];
            touched = {std::min(touched.x, range.x), std::max(touched.y, range.y)};
        }
    return touched;
}

}  // namespace curvewall
