#include "renderer/node_grid.h"

#include "calibration/pieces/piece_fit.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/sphere_slices_lens.h"
#include "tests/support/random_numbers.h"
#include "tests/support/shipped_walls.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace curvewall {
namespace {

Wall sphereSlicesWall(double fovRad) {
    const glm::ivec2 sizePx(400, 300);
    return {"slices",
            {},
            {},
            {{"slices", sizePx, "sphere_slices",
              std::make_shared<LensProjection>(std::make_shared<SphereSlicesLens>(fovRad, fovRad, sizePx),
                                               Orientation{0.3, -0.2, 0.5})}}};
}

struct Case {
    std::string name;
    Wall (*wall)();
};

const Case kCases[]{
    {"CameraTexture", [] { return test::shippedWall("camera-texture"); }},
    {"SphereSlices", [] { return sphereSlicesWall(1.8); }},
    {"WideSphereSlices", [] { return sphereSlicesWall(3.1); }},
    {"FullCylinder",
     [] {
         return test::fullCylinderWall({400, 300});
     }},
    {"OnePiece",
     [] {
         return test::planarWall({400, 300}, 90);
     }},
};

void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

class NodeGridOf : public testing::TestWithParam<Case> {
protected:
    NodeGridOf() {
        for (const ConeNode& node : tree_) {
            if (node.piece >= 0)
                planes_.push_back(edgePlanes(mesh_, piece(node)));
            else
                planes_.emplace_back();
        }
    }

    const Piece& piece(const ConeNode& node) const { return mesh_.pieces[static_cast<size_t>(node.piece)]; }

    bool shows(size_t leaf, glm::dvec3 point) const {
        return std::ranges::all_of(planes_[leaf],
                                   [&](glm::dvec3 plane) { return glm::dot(plane, point) >= 0; });
    }

    glm::dvec3 anyRay(test::Random& random) const {
        for (;;)
            if (const auto ray = wall_.displays[0].projection->unproject(random.pixel(mesh_.sizePx)))
                return glm::normalize(*ray);
    }

    Wall wall_ = GetParam().wall();
    PieceMesh mesh_ = fitPieces(wall_.displays[0], 0.5).mesh;
    std::vector<ConeNode> tree_ = buildPieceTree(mesh_);
    std::vector<std::vector<glm::dvec3>> planes_;  // of each node; none of inner ones
    NodeGrid grid_ = buildNodeGrid(mesh_, tree_);
};

// Points of the sphere tell of some pieces that it touches.
TEST_P(NodeGridOf, HoldsEveryLeafThatASphereTouches) {
    test::Random random(1);
    int hits = 0;
    for (int i = 0; i < 400; ++i) {
        const double distance = std::exp(random.uniform(-1, 4));
        const double radius = distance * std::exp(random.uniform(-9, 0.3));
        const glm::dvec3 towards = i % 4 == 0 ? random.direction() : anyRay(random);
        const glm::dvec3 centre = distance * towards + radius * random.inBox(1);
        const NodeRange range = nodesUnder(grid_, centre, radius);
        for (int k = 0; k < 40; ++k) {
            const glm::dvec3 point = centre + radius * std::cbrt(random.uniform(0, 1)) * random.direction();
            for (size_t leaf = 0; leaf < tree_.size(); ++leaf) {
                if (tree_[leaf].piece < 0 || !shows(leaf, point)) continue;
                ++hits;
                ASSERT_LE(range.x, leaf);
                ASSERT_GT(range.y, leaf);
            }
        }
    }
    EXPECT_GT(hits, 2000);
}

TEST_P(NodeGridOf, HoldsEverythingAroundTheEye) {
    size_t firstLeaf = 0;
    while (tree_[firstLeaf].piece < 0) ++firstLeaf;
    EXPECT_EQ(nodesUnder(grid_, 0.5 * grid_.planes[0].down, 0.6), NodeRange(firstLeaf, tree_.size()));
}

INSTANTIATE_TEST_SUITE_P(Displays, NodeGridOf, testing::ValuesIn(kCases),
                         [](const auto& one) { return one.param.name; });

TEST(NodeGrid, SmallSpheresHaveFewNodes) {
    const Wall wall = sphereSlicesWall(1.8);
    const PieceMesh mesh = fitPieces(wall.displays[0], 0.1).mesh;
    const std::vector<ConeNode> tree = buildPieceTree(mesh);
    const NodeGrid grid = buildNodeGrid(mesh, tree);
    test::Random random(2);
    int few = 0;
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 ray = *wall.displays[0].projection->unproject(random.pixel(mesh.sizePx));
        const NodeRange range = nodesUnder(grid, glm::normalize(ray), 1e-4);
        few += 20 * (range.y - range.x) <= tree.size();
    }
    EXPECT_GT(few, 700) << tree.size();
}

TEST(NodeGrid, HoldsNothingWhereThePiecesAreNot) {
    const PieceMesh mesh = fitPieces(sphereSlicesWall(1.8).displays[0], 0.5).mesh;
    const NodeGrid grid = buildNodeGrid(mesh, buildPieceTree(mesh));
    const glm::dvec3 right = grid.planes[0].right, down = grid.planes[0].down, ahead = grid.planes[0].ahead;
    const auto isEmpty = [&](glm::dvec3 centre, double radius) {
        const NodeRange range = nodesUnder(grid, centre, radius);
        return range.x >= range.y;
    };
    EXPECT_TRUE(isEmpty(-5.0 * ahead, 4));
    EXPECT_TRUE(isEmpty(ahead + 9.0 * right, 2));
    EXPECT_TRUE(isEmpty(ahead - 9.0 * down, 2));
    EXPECT_FALSE(isEmpty(ahead, 0.01));
}

TEST(NodeGrid, WideDisplaysTakeTheSidesOfACubeThatTheyTouch) {
    const auto planes = [](const Wall& wall) {
        const PieceMesh mesh = fitPieces(wall.displays[0], 1).mesh;
        return buildNodeGrid(mesh, buildPieceTree(mesh)).planes.size();
    };
    EXPECT_EQ(planes(sphereSlicesWall(1.8)), 1u);
    // Half a turn both ways shows nothing behind.
    EXPECT_EQ(planes(sphereSlicesWall(3.1)), 5u);
    EXPECT_GE(planes(test::fullCylinderWall({400, 300})), 4u);
}

TEST(NodeGrid, LooksAtFewCellsWhateverTheBox) {
    test::Random random(3);
    for (int i = 0; i < 5000; ++i) {
        const glm::dvec2 least(random.uniform(-2, 2), random.uniform(-2, 2));
        const glm::dvec2 most = least + glm::dvec2(random.uniform(0, 3), random.uniform(0, 3));
        const maths::BoxBounds box{maths::kSphereSeen, least, most};
        const maths::GridCells cells = maths::gridCellsUnder(box, glm::dvec2(-1), glm::dvec2(32), 64);
        if (most.x < -1 || most.y < -1 || least.x >= 1 || least.y >= 1) {
            ASSERT_LT(cells.last.x, cells.first.x);
            continue;
        }
        const glm::ivec2 across = cells.last - cells.first + 1;
        ASSERT_LE(std::max(across.x, across.y), maths::kGridReach);
        // They hold the part of the box within the grid.
        const double side = 2.0 / cells.width;
        ASSERT_TRUE(glm::all(
            glm::lessThanEqual(glm::dvec2(cells.first) * side - 1.0, glm::max(least, glm::dvec2(-1)))));
        ASSERT_TRUE(glm::all(
            glm::greaterThanEqual(glm::dvec2(cells.last + 1) * side - 1.0, glm::min(most, glm::dvec2(1)))));
    }
}

}  // namespace
}  // namespace curvewall
