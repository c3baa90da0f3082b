#include "calibration/pieces/piece_tree.h"

#include "calibration/pieces/piece_fit.h"
#include "tests/support/polygon_meshes.h"
#include "tests/support/random_numbers.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <span>

namespace curvewall {
namespace {

using Triangle = std::array<glm::dvec3, 3>;

std::set<int32_t> piecesTouched(const std::vector<ConeNode>& tree, const Triangle& triangle) {
    std::set<int32_t> pieces;
    for (uint32_t i = 0; i < tree.size();) {
        const std::span planes = std::span(tree[i].planes).first(tree[i].planeCount);
        const bool outside = std::ranges::any_of(planes, [&](const glm::dvec3& plane) {
            return std::ranges::all_of(triangle, [&](const glm::dvec3& p) { return glm::dot(plane, p) < 0; });
        });
        if (outside) {
            i = tree[i].next;
        } else {
            if (tree[i].piece >= 0) pieces.insert(tree[i].piece);
            ++i;
        }
    }
    return pieces;
}

// Whether a ray falls into the piece with its guard.
bool touches(const PieceMesh& mesh, const Piece& piece, glm::dvec3 ray) {
    return std::ranges::all_of(edgePlanes(mesh, piece),
                               [&](const glm::dvec3& p) { return glm::dot(p, ray) >= 0; });
}

class PieceTree : public ::testing::TestWithParam<Wall> {
protected:
    const PieceMesh mesh_ =
        fitPieces(*GetParam().displays[0].projection, GetParam().displays[0].sizePx, 0.25).mesh;
    const std::vector<ConeNode> tree_ = buildPieceTree(mesh_);
};

TEST(PieceTreeOfPolygons, FindsEveryPieceThatARayLiesInAndFewOthers) {
    test::Random random(3);
    const glm::ivec2 sizePx(640, 480);
    const Wall wall = test::planarWall(sizePx, 100);
    const PieceMesh mesh = test::honeycombOn(*wall.displays[0].projection, sizePx, {10, 8, 1, 0}, random);
    const std::vector<ConeNode> tree = buildPieceTree(mesh);
    size_t found = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 ray = *wall.displays[0].projection->unproject(random.pixel(sizePx));
        const std::set<int32_t> pieces = piecesTouched(tree, {ray, ray, ray});
        for (size_t k = 0; k < mesh.pieces.size(); ++k)
            EXPECT_EQ(pieces.contains(static_cast<int32_t>(k)), touches(mesh, mesh.pieces[k], ray));
        found += pieces.size();
    }
    EXPECT_LT(found, 2200u);
}

TEST_P(PieceTree, FindsEveryPieceThatAPointOfATriangleLiesIn) {
    test::Random random(1);
    for (int i = 0; i < 2000; ++i) {
        // From slivers to triangles that surround the eye.
        const glm::dvec3 centre = random.direction() * random.uniform(0, 5);
        const double size = std::exp(random.uniform(-6, 2));
        const Triangle triangle{centre + size * random.inBox(1), centre + size * random.inBox(1),
                                centre + size * random.inBox(1)};
        const std::set<int32_t> found = piecesTouched(tree_, triangle);
        for (int s = 0; s < 20; ++s) {
            double u = random.uniform(0, 1), v = random.uniform(0, 1);
            if (u + v > 1) u = 1 - u, v = 1 - v;
            const glm::dvec3 ray =
                triangle[0] + u * (triangle[1] - triangle[0]) + v * (triangle[2] - triangle[0]);
            for (size_t k = 0; k < mesh_.pieces.size(); ++k)
                if (touches(mesh_, mesh_.pieces[k], ray)) {
                    ASSERT_TRUE(found.contains(static_cast<int32_t>(k))) << "piece " << k;
                }
        }
    }
}

TEST_P(PieceTree, RejectsMostPiecesForSmallTriangles) {
    test::Random random(2);
    size_t found = 0;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 centre = random.direction();
        found +=
            piecesTouched(tree_, {centre, centre + 1e-3 * random.inBox(1), centre + 1e-3 * random.inBox(1)})
                .size();
    }
    EXPECT_LT(found, 2000u);
}

TEST_P(PieceTree, EveryPieceIsALeafOnce) {
    std::multiset<int32_t> leaves;
    for (const ConeNode& node : tree_)
        if (node.piece >= 0) leaves.insert(node.piece);
    EXPECT_EQ(leaves.size(), mesh_.pieces.size());
    EXPECT_EQ(std::set<int32_t>(leaves.begin(), leaves.end()).size(), mesh_.pieces.size());
    EXPECT_EQ(tree_.front().next, tree_.size());
}

INSTANTIATE_TEST_SUITE_P(Walls, PieceTree,
                         ::testing::Values(test::fullCylinderWall({800, 600}),
                                           test::fullCylinderWall({800, 600}, {1.8, 0, 0.2}),
                                           test::cylinderWall({2, 1.5, 1, {}, {0.7, 0.3, 0}}, {}, {640, 480}),
                                           test::planarWall({640, 480}, 90)),
                         [](const auto& wall) { return "Wall" + std::to_string(wall.index); });

}  // namespace
}  // namespace curvewall
