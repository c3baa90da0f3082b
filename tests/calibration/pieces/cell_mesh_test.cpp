#include "calibration/pieces/cell_mesh.h"

#include "calibration/pieces/ownership.h"
#include "tests/support/broken_displays.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace curvewall {
namespace {

constexpr glm::ivec2 kSizePx(96, 80);

struct Made {
    FunctionRays rays;
    CellTree tree;
    std::vector<CellFacets> facets;
    CellMesh cells;
};

// Cells cut at random, so that long edges have hanging vertices, some of which hang on others.
Made made(test::RayAt rayAt, uint64_t seed, int cuts, const std::unordered_set<uint32_t>& loose = {},
          double mostDisagreementPx = 100) {
    Made made{{std::move(rayAt), kSizePx}, CellTree(kSizePx, {3, 2}), {}, {}};
    test::Random random(seed);
    for (int i = 0; i < cuts; ++i) {
        const std::vector<uint32_t> whole = made.tree.wholeCells();
        const uint32_t id = whole[static_cast<size_t>(random.uniform(0, double(whole.size())))];
        const int axis = random.uniform(0, 1) < 0.5;
        if (made.tree.cell(id).sizePx()[axis] >= 2) made.tree.cut(id, axis);
    }
    for (uint32_t id = 0; id < made.tree.cellCount(); ++id)
        made.facets.push_back(facetsOf(made.rays, made.tree.cell(id)));
    made.cells = meshOfCells(made.tree, made.facets, made.rays, loose, mostDisagreementPx);
    return made;
}

int sideOf(const PieceMesh& mesh, const Piece& piece) {
    const auto m = [&](size_t i) { return mesh.vertices[piece.vertices[i]].m; };
    const double det = glm::determinant(glm::dmat3(m(0), m(1), m(2)));
    return (det > 0) - (det < 0);
}

// Vertices that lie within an edge of a piece, with that edge's ends.
struct WithinEdge {
    uint32_t vertex, from, to;
};
std::vector<WithinEdge> verticesWithinEdges(const PieceMesh& mesh) {
    std::vector<WithinEdge> found;
    for (const Piece& piece : mesh.pieces) {
        for (uint32_t i = 0; i < piece.vertexCount; ++i) {
            const uint32_t a = piece.vertices[i], b = piece.vertices[(i + 1) % piece.vertexCount];
            const glm::dvec2 along = mesh.vertices[b].s - mesh.vertices[a].s;
            for (uint32_t v = 0; v < mesh.vertices.size(); ++v) {
                const glm::dvec2 to = mesh.vertices[v].s - mesh.vertices[a].s;
                const double share = glm::dot(to, along) / glm::dot(along, along);
                if (along.x * to.y == along.y * to.x && share > 0 && share < 1) found.push_back({v, a, b});
            }
        }
    }
    return found;
}

TEST(CellMesh, HangingVerticesLieOnTheirLongEdgeInSpaceAndOnTheScreen) {
    for (uint64_t seed : {1, 2, 3}) {
        const Made fisheye = made(test::fisheyeRays({200, 200}), seed, 60);  // the circle is around it
        const PieceMesh& mesh = fisheye.cells.mesh;
        const std::vector<WithinEdge> hanging = verticesWithinEdges(mesh);
        EXPECT_GT(hanging.size(), 20u);
        for (const auto& [vertex, from, to] : hanging) {
            const PieceVertex &a = mesh.vertices[from], &b = mesh.vertices[to], &v = mesh.vertices[vertex];
            const double share = glm::distance(v.s, a.s) / glm::distance(b.s, a.s);
            EXPECT_LT(glm::distance(v.m, glm::mix(a.m, b.m, share)), 1e-12 * glm::length(v.m));
        }
    }
}

TEST(CellMesh, HangingVerticesStayOnTheirLongEdgeHoweverTheFacetsMove) {
    const Made fisheye = made(test::fisheyeRays({200, 200}), 4, 60);
    PieceMesh moved = fisheye.cells.mesh;
    test::Random random(5);
    std::vector<glm::dvec3> step(fisheye.cells.motion.unknownCount());
    for (glm::dvec3& s : step) s = random.inBox(0.1);
    for (size_t v = 0; v < moved.vertices.size(); ++v)
        for (const Motion::Term& term : fisheye.cells.motion.termsOf(v))
            moved.vertices[v].m += term.weight * step[term.unknown];
    for (const auto& [vertex, from, to] : verticesWithinEdges(moved)) {
        const PieceVertex &a = moved.vertices[from], &b = moved.vertices[to], &v = moved.vertices[vertex];
        const double share = glm::distance(v.s, a.s) / glm::distance(b.s, a.s);
        EXPECT_LT(glm::distance(v.m, glm::mix(a.m, b.m, share)), 1e-12 * glm::length(v.m));
    }
}

TEST(CellMesh, ASmoothDisplayIsOneMeshWithoutTwoVerticesAtOnePlace) {
    const Made fisheye = made(test::fisheyeRays({200, 200}), 6, 80);
    std::set<std::pair<double, double>> places;
    for (const PieceVertex& vertex : fisheye.cells.mesh.vertices) places.insert({vertex.s.x, vertex.s.y});
    EXPECT_EQ(places.size(), fisheye.cells.mesh.vertices.size());
}

TEST(CellMesh, PiecesOwnEveryPixelWithARayOnce) {
    const Made fisheye = made(test::fisheyeRays(kSizePx), 7, 80);
    const PieceMesh& mesh = fisheye.cells.mesh;
    std::vector<int> cover(static_cast<size_t>(kSizePx.x * kSizePx.y));
    for (const Piece& piece : mesh.pieces) {
        PieceMesh alone = mesh;
        alone.pieces = {piece};
        const std::vector<int32_t> owners = ownerImage(alone);
        for (size_t i = 0; i < owners.size(); ++i) cover[i] += owners[i] != kNoPiece;
    }
    for (size_t i = 0; i < cover.size(); ++i) {
        ASSERT_LE(cover[i], 1);
        const auto x = static_cast<int>(i) % kSizePx.x, y = static_cast<int>(i) / kSizePx.x;
        if (PixelRays::isRay(fisheye.rays.at({x, y}))) {
            ASSERT_EQ(cover[i], 1);
        }
    }
    ASSERT_EQ(fisheye.cells.cellOfPiece.size(), mesh.pieces.size());
    for (uint32_t cell : fisheye.cells.cellOfPiece) EXPECT_FALSE(fisheye.facets[cell].isEmpty);
}

TEST(CellMesh, AJumpIsNotBridged) {
    // The right half shows what lies 30 px further: vertices on the jump are there once for each side.
    const auto jump = [](glm::dvec2 px) { return glm::dvec2(px.x < 48 ? 0 : 30, 0); };
    const FunctionRays rays(test::displaced(test::flatRays(kSizePx), jump), kSizePx);
    CellTree tree(kSizePx, {4, 4});
    std::vector<CellFacets> facets;
    for (uint32_t id = 0; id < tree.cellCount(); ++id) facets.push_back(facetsOf(rays, tree.cell(id)));
    const CellMesh cells = meshOfCells(tree, facets, rays, {}, 5);
    std::map<std::pair<double, double>, int> vertices;
    for (const PieceVertex& vertex : cells.mesh.vertices) ++vertices[{vertex.s.x, vertex.s.y}];
    EXPECT_EQ(vertices.size(), 25u);
    for (const auto& [at, count] : vertices) EXPECT_EQ(count, at.first == 48 ? 2 : 1) << at.first;
}

TEST(CellMesh, MirroredHalvesKeepTheirSides) {
    // The right half is the left one's mirror image: on the fold both show the same.
    const auto mirror = [](glm::dvec2 px) { return glm::dvec2(px.x < 48 ? 0 : 2 * (48 - px.x), 0); };
    const FunctionRays rays(test::displaced(test::flatRays(kSizePx), mirror), kSizePx);
    CellTree tree(kSizePx, {4, 4});
    std::vector<CellFacets> facets;
    for (uint32_t id = 0; id < tree.cellCount(); ++id) facets.push_back(facetsOf(rays, tree.cell(id)));
    const CellMesh cells = meshOfCells(tree, facets, rays, {}, 5);
    for (size_t k = 0; k < cells.mesh.pieces.size(); ++k)
        EXPECT_EQ(sideOf(cells.mesh, cells.mesh.pieces[k]),
                  tree.cell(cells.cellOfPiece[k]).fromPx.x < 48 ? 1 : -1);
}

TEST(CellMesh, LooseCellsLieOnTheirOwnPlanesAndNothingMovesThem) {
    std::unordered_set<uint32_t> loose;
    for (uint32_t id = 0; id < 1000; id += 3) loose.insert(id);
    const Made fisheye = made(test::fisheyeRays({200, 200}), 8, 60, loose);
    const PieceMesh& mesh = fisheye.cells.mesh;
    for (size_t k = 0; k < mesh.pieces.size(); ++k) {
        const uint32_t id = fisheye.cells.cellOfPiece[k];
        if (!loose.contains(id)) continue;
        const Cell& cell = fisheye.tree.cell(id);
        for (uint32_t i = 0; i < 3; ++i) {
            const uint32_t vertex = mesh.pieces[k].vertices[i];
            EXPECT_TRUE(fisheye.cells.motion.termsOf(vertex).empty());
            const auto corners = cornersOf(cell);
            const auto at = static_cast<size_t>(
                std::ranges::find(corners, glm::ivec2(mesh.vertices[vertex].s)) - corners.begin());
            EXPECT_LT(glm::distance(mesh.vertices[vertex].m, fisheye.facets[id].corners.at(at)), 1e-6);
        }
    }
    for (const FacetSample& sample : fisheye.cells.samples)
        EXPECT_FALSE(loose.contains(fisheye.cells.cellOfPiece[sample.piece]));
}

}  // namespace
}  // namespace curvewall
