#include "bench/ingredients/uniform_grid.h"

#include "calibration/pieces/facet_balance.h"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace curvewall {
namespace {

glm::dvec3 rayAt(const MeasuredWall& wall, glm::dvec2 px) { return wall.continued->unproject(px).value(); }

// Vertices at even steps of the pixels.
PieceGrid gridOverPixels(const MeasuredWall& wall, glm::ivec2 cells) {
    PieceGrid grid{wall.sizePx, cells.x, cells.y, {}};
    for (int row = 0; row <= cells.y; ++row) {
        for (int column = 0; column <= cells.x; ++column) {
            const glm::dvec2 share = glm::dvec2(column, row) / glm::dvec2(cells);
            const glm::dvec2 s = snapToGrid(share * glm::dvec2(grid.sizePx));
            grid.vertices.push_back({rayAt(wall, s), s});
        }
    }
    return grid;
}

// Vertices at even steps of the base image, which the display's corners are corners of.
PieceGrid gridOverImage(const MeasuredWall& wall, glm::ivec2 cells) {
    PieceGrid grid{wall.sizePx, cells.x, cells.y, {}};
    const glm::dvec2 size = grid.sizePx;
    const glm::dvec3 origin = rayAt(wall, {0, 0});
    const glm::dvec3 across = rayAt(wall, {size.x, 0}) - origin, down = rayAt(wall, {0, size.y}) - origin;
    for (int row = 0; row <= cells.y; ++row) {
        for (int column = 0; column <= cells.x; ++column) {
            const glm::dvec2 share = glm::dvec2(column, row) / glm::dvec2(cells);
            const glm::dvec3 m = origin + share.x * across + share.y * down;
            grid.vertices.push_back({m, snapToGrid(wall.projection->project(m).at(0))});
        }
    }
    return grid;
}

PieceGrid evenGrid(const MeasuredWall& wall, glm::ivec2 cells) {
    return wall.surface == Surface::image ? gridOverImage(wall, cells) : gridOverPixels(wall, cells);
}

std::set<std::pair<uint32_t, uint32_t>> edgesOf(const PieceMesh& mesh) {
    std::set<std::pair<uint32_t, uint32_t>> edges;
    for (const Piece& piece : mesh.pieces)
        for (uint32_t i = 0; i < piece.vertexCount; ++i)
            edges.insert(std::minmax(uint32_t{piece.vertices[i]},
                                     uint32_t{piece.vertices[(i + 1) % piece.vertexCount]}));
    return edges;
}

// An edge shows the ray r in its middle when its ends d_a a and d_b b are such that d_a (a x r) and d_b (r x
// b) are the same. Least squares on log d over all edges, mean 0.
void fitDistances(const MeasuredWall& wall, PieceMesh& mesh) {
    const auto count = static_cast<Eigen::Index>(mesh.vertices.size());
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
    for (const auto& [i, j] : edgesOf(mesh)) {
        PieceVertex &a = mesh.vertices[i], &b = mesh.vertices[j];
        const glm::dvec3 middle = rayAt(wall, 0.5 * (a.s + b.s)), normal = glm::cross(a.m, b.m);
        const double ratio =
            glm::dot(glm::cross(middle, b.m), normal) / glm::dot(glm::cross(a.m, middle), normal);
        if (!(ratio > 0 && std::isfinite(ratio))) continue;
        const int row = static_cast<int>(i), column = static_cast<int>(j);
        entries.insert(entries.end(),
                       {{row, row, 1}, {column, column, 1}, {row, column, -1}, {column, row, -1}});
        right[row] += std::log(ratio);
        right[column] -= std::log(ratio);
    }
    constexpr double kTrace = 1e-9;  // of "distance one", which fixes the mean
    for (int i = 0; i < count; ++i) entries.emplace_back(i, i, kTrace);
    Eigen::SparseMatrix<double> normal(count, count);
    normal.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd logs = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(normal).solve(right);
    for (Eigen::Index i = 0; i < count; ++i) mesh.vertices[static_cast<size_t>(i)].m *= std::exp(logs[i]);
    updateHomographies(mesh);
}

// A lattice over a triangle, its borders included.
std::vector<FacetSample> latticeSamples(const MeasuredWall& wall, const PieceMesh& mesh, uint32_t piece,
                                        int steps) {
    std::vector<FacetSample> samples;
    const auto s = [&](size_t i) { return mesh.vertices[mesh.pieces[piece].vertices[i]].s; };
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; i + j <= steps; ++j) {
            const double b = double(i) / steps, c = double(j) / steps, a = 1 - b - c;
            const glm::dvec2 px = a * s(0) + b * s(1) + c * s(2);
            if (const auto ray = wall.projection->unproject(px))
                samples.push_back({piece, {a, b, c}, px, *ray});
        }
    }
    return samples;
}

std::vector<FacetSample> samplesOf(const MeasuredWall& wall, const PieceMesh& mesh) {
    constexpr int kSteps = 4, kStepsBesideHoles = 16;
    constexpr size_t kPointsOfWhole = (kSteps + 1) * (kSteps + 2) / 2;
    std::vector<FacetSample> samples;
    for (uint32_t k = 0; k < mesh.pieces.size(); ++k) {
        std::vector<FacetSample> own = latticeSamples(wall, mesh, k, kSteps);
        if (own.size() < kPointsOfWhole) own = latticeSamples(wall, mesh, k, kStepsBesideHoles);
        samples.insert(samples.end(), own.begin(), own.end());
    }
    return samples;
}

}  // namespace

PieceMesh paperGrid(const MeasuredWall& wall, glm::ivec2 cells) {
    PieceGrid grid = evenGrid(wall, cells);
    if (wall.surface != Surface::image)
        for (PieceVertex& vertex : grid.vertices) vertex.m = glm::normalize(vertex.m);
    return meshFromGrid(grid, false);
}

PieceMesh gridOnSurface(const MeasuredWall& wall, glm::ivec2 cells) {
    PieceMesh mesh = meshFromGrid(evenGrid(wall, cells), false);
    if (wall.surface != Surface::measured) fitDistances(wall, mesh);
    return mesh;
}

PieceMesh balancedGrid(const MeasuredWall& wall, glm::ivec2 cells, double goodEnoughPx) {
    PieceMesh mesh = gridOnSurface(wall, cells);
    Motion motion;
    for (uint32_t vertex = 0; vertex < mesh.vertices.size(); ++vertex)
        motion.addVertex(std::array<Motion::Term, 1>{{{vertex, 1}}});
    const std::vector<FacetSample> samples = samplesOf(wall, mesh);
    return balanceFacets(std::move(mesh), motion, samples, goodEnoughPx).mesh;
}

}  // namespace curvewall
