#include "calibration/projections/warp_mesh.h"

#include "calibration/parallel.h"
#include "calibration/projections/grid_map.h"

#include <boost/geometry/algorithms/disjoint.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace curvewall {
namespace {

namespace bg = boost::geometry;
using BoxPoint = bg::model::d2::point_xy<double>;
using Box = bg::model::box<BoxPoint>;

// What the blend of a cell's corners rounds by, as a share of the largest position.
constexpr double kRounding = 1e-12;

int cornersOf(const WarpCell& cell) { return cell.shape == CellShape::triangle ? 3 : 4; }

template <class Add>
void forGridCells(glm::ivec2 vertices, const Add& add) {
    const auto columns = static_cast<uint32_t>(vertices.x);
    for (uint32_t y = 0; y + 1 < static_cast<uint32_t>(vertices.y); ++y)
        for (uint32_t x = 0; x + 1 < columns; ++x) {
            const uint32_t first = y * columns + x;
            add(first, first + 1, first + columns, first + columns + 1);
        }
}

}  // namespace

struct WarpMesh::Boxes {
    bg::index::rtree<std::pair<Box, uint32_t>, bg::index::rstar<16>> tree;  // with the number of the cell
};

std::vector<WarpCell> quadrilateralsOfGrid(glm::ivec2 vertices) {
    std::vector<WarpCell> cells;
    forGridCells(vertices, [&](uint32_t v00, uint32_t v10, uint32_t v01, uint32_t v11) {
        cells.push_back({{v00, v10, v01, v11}, CellShape::quadrilateral});
    });
    return cells;
}

std::vector<WarpCell> trianglesOfGrid(glm::ivec2 vertices, CellCut cut) {
    std::vector<WarpCell> cells;
    forGridCells(vertices, [&](uint32_t v00, uint32_t v10, uint32_t v01, uint32_t v11) {
        const bool isEvenRow = v00 / static_cast<uint32_t>(vertices.x) % 2 == 0;
        const bool across = cut == CellCut::across || (cut == CellCut::alternating && isEvenRow);
        cells.push_back({{v00, v10, across ? v01 : v11, 0}, CellShape::triangle});
        cells.push_back({{across ? v10 : v00, v11, v01, 0}, CellShape::triangle});
    });
    return cells;
}

WarpMesh::WarpMesh(std::vector<WarpVertex> vertices, const std::vector<WarpCell>& cells, double extentPx)
    : vertices_(std::move(vertices)), slackPx_(kRounding * extentPx) {
    std::ranges::copy_if(cells, std::back_inserter(cells_), [this](const WarpCell& c) { return !isHole(c); });
    int64_t facing = 0;
    for (const WarpCell& cell : cells_) facing += facingAt(cell, glm::dvec2(1.0 / 3)) < 0 ? -1 : 1;
    facing_ = facing < 0 ? -1 : 1;
    onScreen_ = boxesOf(&WarpVertex::screenPx);
    inSource_ = boxesOf(&WarpVertex::sourcePx);
}

WarpMesh::~WarpMesh() = default;

bool WarpMesh::isHole(const WarpCell& cell) const {
    for (int i = 0; i < cornersOf(cell); ++i)
        if (!vertices_[cell.vertices[static_cast<size_t>(i)]].isValid) return true;
    for (const auto place : {&WarpVertex::screenPx, &WarpVertex::sourcePx}) {
        const maths::BilinearCell c = cellOf(cell, place);
        const auto corner = [&](double s, double t) { return maths::bilinearAt(c, {s, t}); };
        if (!spansArea(corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1), 1e3 * slackPx_)) return true;
    }
    return false;
}

maths::BilinearCell WarpMesh::cellOf(const WarpCell& cell, glm::dvec2 WarpVertex::*place) const {
    const auto corner = [&](size_t i) { return vertices_[cell.vertices[i]].*place; };
    const glm::dvec2 v00 = corner(0), v10 = corner(1), v01 = corner(2);
    return maths::bilinearCell(v00, v10, v01,
                               cell.shape == CellShape::triangle ? v10 + (v01 - v00) : corner(3));
}

// Positive where screen and source show the same side.
double WarpMesh::facingAt(const WarpCell& cell, glm::dvec2 st) const {
    return maths::bilinearDeterminant(cellOf(cell, &WarpVertex::screenPx), st) *
           maths::bilinearDeterminant(cellOf(cell, &WarpVertex::sourcePx), st);
}

double WarpMesh::intensityAt(const WarpCell& cell, glm::dvec2 st) const {
    const auto corner = [&](size_t i) { return vertices_[cell.vertices[i]].intensity; };
    const double i00 = corner(0), i10 = corner(1), i01 = corner(2);
    const double i11 = cell.shape == CellShape::triangle ? i10 + (i01 - i00) : corner(3);
    return std::lerp(std::lerp(i00, i10, st.x), std::lerp(i01, i11, st.x), st.y);
}

std::unique_ptr<const WarpMesh::Boxes> WarpMesh::boxesOf(glm::dvec2 WarpVertex::*place) const {
    std::vector<std::pair<Box, uint32_t>> boxes;
    for (uint32_t number = 0; number < cells_.size(); ++number) {
        const WarpCell& cell = cells_[number];
        glm::dvec2 low = vertices_[cell.vertices[0]].*place, high = low;
        for (int i = 1; i < cornersOf(cell); ++i) {
            const glm::dvec2 corner = vertices_[cell.vertices[static_cast<size_t>(i)]].*place;
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
        boxes.push_back(
            {{{low.x - slackPx_, low.y - slackPx_}, {high.x + slackPx_, high.y + slackPx_}}, number});
    }
    return std::make_unique<const Boxes>(Boxes{{boxes.begin(), boxes.end()}});
}

std::optional<WarpMesh::Sample> WarpMesh::at(glm::dvec2 screenPx) const {
    using Rank = std::pair<bool, uint32_t>;
    std::optional<std::pair<Rank, glm::dvec2>> best;
    const auto tryCell = [&](const std::pair<Box, uint32_t>& entry) {
        const WarpCell& cell = cells_[entry.second];
        solveCell(cellOf(cell, &WarpVertex::screenPx), cell.shape, screenPx, slackPx_, [&](glm::dvec2 st) {
            const Rank rank{facingAt(cell, st) * facing_ <= 0, entry.second};
            if (!best || rank < best->first) best = {rank, st};
        });
    };
    onScreen_->tree.query(bg::index::intersects(BoxPoint(screenPx.x, screenPx.y)),
                          boost::make_function_output_iterator(tryCell));
    if (!best) return std::nullopt;
    const WarpCell& cell = cells_[best->first.second];
    return Sample{maths::bilinearAt(cellOf(cell, &WarpVertex::sourcePx), best->second),
                  intensityAt(cell, best->second)};
}

std::vector<glm::dvec2> WarpMesh::positions(glm::dvec2 sourcePx) const {
    std::vector<glm::dvec2> positions;
    const auto tryCell = [&](const std::pair<Box, uint32_t>& entry) {
        const WarpCell& cell = cells_[entry.second];
        solveCell(cellOf(cell, &WarpVertex::sourcePx), cell.shape, sourcePx, slackPx_, [&](glm::dvec2 st) {
            addIfNew(positions, maths::bilinearAt(cellOf(cell, &WarpVertex::screenPx), st));
        });
    };
    inSource_->tree.query(bg::index::intersects(BoxPoint(sourcePx.x, sourcePx.y)),
                          boost::make_function_output_iterator(tryCell));
    return positions;
}

WarpMeshProjection::WarpMeshProjection(std::shared_ptr<const WarpMesh> mesh, ProjectionPtr source)
    : mesh_(std::move(mesh)), source_(std::move(source)) {}

std::optional<glm::dvec3> WarpMeshProjection::unproject(glm::dvec2 px) const {
    const auto sample = mesh_->at(px);
    return sample ? source_->unproject(sample->sourcePx) : std::nullopt;
}

std::vector<glm::dvec2> WarpMeshProjection::project(glm::dvec3 ray) const {
    std::vector<glm::dvec2> positions;
    for (const glm::dvec2 sourcePx : source_->project(ray))
        for (const glm::dvec2 px : mesh_->positions(sourcePx)) addIfNew(positions, px);
    return positions;
}

ProjectionPtr WarpMeshProjection::seenFrom(glm::dvec3 eyeM) const {
    return std::make_shared<WarpMeshProjection>(mesh_, source_->seenFrom(eyeM));
}

std::vector<float> linearIntensity(const WarpMesh& mesh, glm::ivec2 sizePx, double gamma) {
    std::vector<float> factors(static_cast<size_t>(sizePx.x) * static_cast<size_t>(sizePx.y), 1.0f);
    parallelRanges(sizePx.y, [&](int begin, int end) {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < sizePx.x; ++x)
                if (const auto sample = mesh.at({x + 0.5, y + 0.5}))
                    factors[static_cast<size_t>(y) * static_cast<size_t>(sizePx.x) + static_cast<size_t>(x)] =
                        static_cast<float>(std::pow(sample->intensity, gamma));
    });
    if (std::ranges::all_of(factors, [](float factor) { return factor == 1; })) return {};
    return factors;
}

}  // namespace curvewall
