#include "calibration/pieces/facet_balance.h"

#include "tests/support/random_numbers.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

// An arc of 60 degrees, 100 px wide: the ray of column x.
glm::dvec3 onArc(double x, double y) {
    const double angle = (x / 100 - 0.5) * 1.05;
    return {std::sin(angle), (y / 100 - 0.5), -std::cos(angle)};
}

// `columns` x 1 cells of two triangles with vertices on the arc.
PieceMesh arcMesh(int columns) {
    PieceGrid grid{{100, 100}, columns, 1, {}};
    for (const double y : {0.0, 100.0})
        for (int i = 0; i <= columns; ++i)
            grid.vertices.push_back({onArc(100.0 * i / columns, y), snapToGrid({100.0 * i / columns, y})});
    return meshFromGrid(grid, false);
}

std::vector<FacetSample> samplesOf(const PieceMesh& mesh) {
    std::vector<FacetSample> samples;
    for (uint32_t k = 0; k < mesh.pieces.size(); ++k) {
        const auto s = [&](size_t i) { return mesh.vertices[mesh.pieces[k].vertices[i]].s; };
        for (int i = 0; i <= 6; ++i) {
            for (int j = 0; i + j <= 6; ++j) {
                const double u = i / 6.0, v = j / 6.0;
                const glm::dvec2 px = (1 - u - v) * s(0) + u * s(1) + v * s(2);
                samples.push_back({k, {1 - u - v, u, v, 0}, px, onArc(px.x, px.y)});
            }
        }
    }
    return samples;
}

Motion freeMotion(const PieceMesh& mesh) {
    Motion motion;
    for (uint32_t v = 0; v < mesh.vertices.size(); ++v)
        motion.addVertex(std::array<Motion::Term, 1>{{{v, 1}}});
    return motion;
}

// Where the ray meets the facet, as a blend of its corners: written apart from the homographies.
double largestErrorPx(const PieceMesh& mesh, const std::vector<FacetSample>& samples) {
    double largest = 0;
    for (const FacetSample& sample : samples) {
        const auto corner = [&](size_t i) { return mesh.vertices[mesh.pieces[sample.piece].vertices[i]]; };
        const glm::dvec3 b = glm::inverse(glm::dmat3(corner(0).m, corner(1).m, corner(2).m)) * sample.ray;
        const glm::dvec2 px = (b.x * corner(0).s + b.y * corner(1).s + b.z * corner(2).s) / (b.x + b.y + b.z);
        largest = std::max(largest, glm::distance(px, sample.px));
    }
    return largest;
}

TEST(FacetBalance, AboutHalvesTheErrorOfFacetsOnTheSurface) {
    const PieceMesh mesh = arcMesh(5);
    const std::vector<FacetSample> samples = samplesOf(mesh);
    const BalancedPieces balanced = balanceFacets(mesh, freeMotion(mesh), samples, 0);
    EXPECT_NEAR(largestErrorPx(balanced.mesh, samples), balanced.sampledMaxPx, 1e-9);
    EXPECT_LT(balanced.sampledMaxPx, 0.6 * largestErrorPx(mesh, samples));
}

TEST(FacetBalance, NeverMakesTheMaximumLarger) {
    test::Random random(1);
    for (int i = 0; i < 50; ++i) {
        PieceMesh mesh = arcMesh(1 + i % 6);
        for (PieceVertex& vertex : mesh.vertices) vertex.m += random.inBox(0.02);
        updateHomographies(mesh);
        const std::vector<FacetSample> samples = samplesOf(mesh);
        const BalancedPieces balanced = balanceFacets(mesh, freeMotion(mesh), samples, 0);
        EXPECT_LE(largestErrorPx(balanced.mesh, samples), largestErrorPx(mesh, samples) + 1e-12);
    }
}

TEST(FacetBalance, KeepsScreenPositionsAndSides) {
    test::Random random(2);
    for (int i = 0; i < 50; ++i) {
        PieceMesh mesh = arcMesh(4);
        for (PieceVertex& vertex : mesh.vertices) vertex.m += random.inBox(0.1);
        updateHomographies(mesh);
        const PieceMesh balanced = balanceFacets(mesh, freeMotion(mesh), samplesOf(mesh), 0).mesh;
        for (size_t v = 0; v < mesh.vertices.size(); ++v)
            EXPECT_EQ(balanced.vertices[v].s, mesh.vertices[v].s);
        for (const Piece& piece : mesh.pieces) {
            const auto det = [&](const PieceMesh& of) {
                return glm::determinant(glm::dmat3(of.vertices[piece.vertices[0]].m,
                                                   of.vertices[piece.vertices[1]].m,
                                                   of.vertices[piece.vertices[2]].m));
            };
            EXPECT_GT(det(mesh) * det(balanced), 0);
        }
    }
}

TEST(FacetBalance, VerticesThatShareAnUnknownMoveAlike) {
    const PieceMesh mesh = arcMesh(3);
    Motion motion;  // all vertices of the top row move as one, the others not at all
    for (uint32_t v = 0; v < mesh.vertices.size(); ++v) {
        const std::array<Motion::Term, 1> shared{{{0, 1}}};
        motion.addVertex(v < 4 ? std::span<const Motion::Term>(shared) : std::span<const Motion::Term>());
    }
    ASSERT_EQ(motion.unknownCount(), 1u);
    const PieceMesh balanced = balanceFacets(mesh, motion, samplesOf(mesh), 0).mesh;
    // All points may have been scaled about the eye by one factor.
    const double scale = glm::length(balanced.vertices[4].m) / glm::length(mesh.vertices[4].m);
    const glm::dvec3 step = balanced.vertices[0].m / scale - mesh.vertices[0].m;
    EXPECT_GT(glm::length(step), 1e-6);
    for (size_t v = 0; v < 8; ++v)
        EXPECT_LT(glm::distance(balanced.vertices[v].m / scale,
                                mesh.vertices[v].m + (v < 4 ? step : glm::dvec3(0))),
                  1e-12);
}

TEST(FacetBalance, StopsWhereItIsGoodEnough) {
    const PieceMesh mesh = arcMesh(3);
    const std::vector<FacetSample> samples = samplesOf(mesh);
    const double before = largestErrorPx(mesh, samples);
    const BalancedPieces untouched = balanceFacets(mesh, freeMotion(mesh), samples, 2 * before);
    for (size_t v = 0; v < mesh.vertices.size(); ++v)
        EXPECT_EQ(untouched.mesh.vertices[v].m, mesh.vertices[v].m);
}

TEST(FacetBalance, AMeshThatMayNotMoveIsLeftAsItIs) {
    const PieceMesh mesh = arcMesh(2);
    Motion none;
    for (size_t v = 0; v < mesh.vertices.size(); ++v) none.addVertex({});
    const PieceMesh balanced = balanceFacets(mesh, none, {}, 0.1).mesh;
    for (size_t v = 0; v < mesh.vertices.size(); ++v) EXPECT_EQ(balanced.vertices[v].m, mesh.vertices[v].m);
}

}  // namespace
}  // namespace curvewall
