#include "calibration/pieces/quad_grid_fit.h"

#include "calibration/pieces/piece_fit.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace curvewall {
namespace {

constexpr int kLattice = 4;  // samples per piece edge, less one
// The error falls with the square of the fineness. A display on which that much is not enough breaks
// somewhere; cells of a grid do not mend that.
constexpr double kFinest = 8;

// The first vertex's point plus what its column and its row add: m(i, j) = u(i) + v(j), which every grid of
// parallelograms is. Exactness is a constraint of the fit and not a tolerance.
Motion quadGridMotion(const PieceGrid& grid) {
    Motion motion;
    const auto columns = static_cast<uint32_t>(grid.columns) + 1;
    for (uint32_t row = 0; row <= static_cast<uint32_t>(grid.rows); ++row)
        for (uint32_t column = 0; column < columns; ++column)
            motion.addVertex(std::array<Motion::Term, 2>{{{column, 1}, {columns + row, 1}}});
    return motion;
}

// A lattice over every piece, its borders included.
std::vector<FacetSample> latticeSamples(const Projection& projection, const PieceMesh& mesh) {
    std::vector<FacetSample> samples;
    for (uint32_t k = 0; k < mesh.pieces.size(); ++k) {
        for (int i = 0; i <= kLattice; ++i) {
            for (int j = 0; j <= kLattice; ++j) {
                const double u = double(i) / kLattice, v = double(j) / kLattice;
                const std::array<double, kMostPieceEdges> blend{(1 - u) * (1 - v), u * (1 - v), u * v,
                                                                (1 - u) * v};
                glm::dvec2 px(0);
                for (size_t c = 0; c < 4; ++c) px += blend[c] * mesh.vertices[mesh.pieces[k].vertices[c]].s;
                if (const auto ray = projection.unproject(px)) samples.push_back({k, blend, px, *ray});
            }
        }
    }
    return samples;
}

// A display all of whose pixels see one ray, or rays in one plane with the eye, has no facets of this kind.
bool hasArea(const PieceGrid& grid) {
    constexpr double kLeastShare = 1e-12;  // of the cube of the distance
    return std::ranges::all_of(meshFromGrid(grid, true).pieces, [&](const Piece& piece) {
        const auto m = [&](size_t i) { return grid.vertices[piece.vertices[i]].m; };
        const double distance = glm::length(m(0));
        return std::abs(glm::determinant(glm::dmat3(m(0), m(1), m(2)))) >
               kLeastShare * distance * distance * distance;
    });
}

}  // namespace

bool unrolls(const Projection& projection, glm::ivec2 sizePx) {
    constexpr int kCells = 7;  // at hardly any period that a display may have
    PieceGrid grid{sizePx, kCells, kCells, {}};
    for (int row = 0; row <= kCells; ++row) {
        for (int column = 0; column <= kCells; ++column) {
            const glm::dvec2 px = glm::dvec2(sizePx * glm::ivec2(column, row)) / double(kCells);
            const auto ray = projection.unproject(px);
            if (!ray) return false;
            grid.vertices.push_back({*ray, px});
        }
    }
    return isQuadGrid(grid) && hasArea(grid);
}

BalancedGrid balancedGrid(const Projection& projection, const BendProfile& profile, glm::ivec2 counts,
                          const std::stop_token& stop) {
    const PieceGrid grid = profile.grid(projection, counts.x, counts.y);
    PieceMesh mesh = meshFromGrid(grid, true);
    const std::vector<FacetSample> samples = latticeSamples(projection, mesh);
    Motion motion = quadGridMotion(grid);
    BalancedPieces pieces = balanceFacets(std::move(mesh), motion, samples, 0, stop);
    return {std::move(pieces), std::move(motion), counts};
}

QuadGridSearch::QuadGridSearch(const Projection& projection, glm::ivec2 sizePx, double tolerancePx,
                               const std::stop_token& stop)
    : projection_(projection), profile_(projection, sizePx), tolerancePx_(tolerancePx), stop_(stop) {}

std::optional<BalancedGrid> QuadGridSearch::coarsest() {
    double next = 0.7;  // balancing halves the error, so about sqrt(1/2)
    double fails = 0;
    std::optional<BalancedGrid> found;
    while (next <= kFinest) {
        BalancedGrid tried = at(next);
        const double sampledMaxPx = tried.pieces.sampledMaxPx;
        if (sampledMaxPx <= tolerancePx_) {
            fineness_ = next;
            found = std::move(tried);
        } else {
            fails = next;
        }
        if (found && !hasGridBetween(fails, fineness_)) return found;
        next = guess(next, sampledMaxPx, fails, found ? fineness_ : std::numeric_limits<double>::infinity());
    }
    return std::nullopt;
}

std::optional<BalancedGrid> QuadGridSearch::finer() {
    fineness_ = nextFiner(fineness_);
    if (fineness_ > kFinest) return std::nullopt;
    return at(fineness_);
}

BalancedGrid QuadGridSearch::at(double fineness) const {
    const glm::dvec2 cells = cellsAt(fineness);
    if (!(cells.x * cells.y <= kMostPieces)) refuseTolerance(tolerancePx_);
    return balancedGrid(projection_, profile_, glm::ivec2(cells), stop_);
}

// Whole numbers, but as many as they may be.
glm::dvec2 QuadGridSearch::cellsAt(double fineness) const {
    const auto count = [&](double cells) { return std::max(1.0, std::ceil(cells * fineness - 1e-6)); };
    return {count(profile_.columnsFor(tolerancePx_)), count(profile_.rowsFor(tolerancePx_))};
}

// Where nothing bends no fineness gives more cells: what is wrong there, cells do not mend.
double QuadGridSearch::nextFiner(double fineness) const {
    double next = fineness;
    do next *= 1.002;
    while (next <= kFinest && cellsAt(next) == cellsAt(fineness));
    return next;
}

// Columns and rows may grow at one fineness: then no grid lies between two that differ in both.
bool QuadGridSearch::hasGridBetween(double fails, double passes) const {
    const glm::dvec2 gap = cellsAt(passes) - cellsAt(fails);
    return gap.x + gap.y > 1 && passes - fails > 1e-3 * passes;
}

// The error falls with the square of the fineness. Where that leads out of the bracket or nowhere new,
// halve it.
double QuadGridSearch::guess(double tried, double sampledMaxPx, double fails, double passes) const {
    const double expected = tried * std::sqrt(sampledMaxPx / tolerancePx_);
    if (std::isinf(passes)) return std::max(nextFiner(fails), std::min(expected, 2 * fails));
    const bool isNew = expected > fails && expected < passes && cellsAt(expected) != cellsAt(fails) &&
                       cellsAt(expected) != cellsAt(passes);
    return isNew ? expected : 0.5 * (fails + passes);
}

}  // namespace curvewall
