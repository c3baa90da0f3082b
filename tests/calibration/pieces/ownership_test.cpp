#include "calibration/pieces/ownership.h"

#include "tests/support/random_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace curvewall {
namespace {

// Triangles of a grid whose inner vertices are moved at random, snapped; the m do not matter here.
PieceMesh wobblyTriangles(glm::ivec2 sizePx, int cells, uint64_t seed) {
    test::Random random(seed);
    std::vector<PieceVertex> vertices;
    for (int y = 0; y <= cells; ++y) {
        for (int x = 0; x <= cells; ++x) {
            glm::dvec2 s = glm::dvec2(x, y) * glm::dvec2(sizePx) / double(cells);
            const double reach = 0.3 * sizePx.x / cells;
            if (x > 0 && x < cells) s.x += random.uniform(-reach, reach);
            if (y > 0 && y < cells) s.y += random.uniform(-reach, reach);
            s = snapToGrid(s);
            vertices.push_back({{s.x, s.y, 100 + 10 * random.uniform(0, 1)}, s});
        }
    }
    return meshFromGrid({sizePx, cells, cells, std::move(vertices)}, false);
}

PieceMesh alone(const PieceMesh& mesh, size_t piece) {
    return {mesh.sizePx, mesh.vertices, {mesh.pieces[piece]}};
}

TEST(Ownership, EveryPixelHasExactlyOneOwner) {
    for (uint64_t seed = 1; seed <= 20; ++seed) {
        const PieceMesh mesh = wobblyTriangles({61, 47}, 7, seed);
        std::vector<int> owners(61 * 47);
        for (size_t k = 0; k < mesh.pieces.size(); ++k) {
            const std::vector<int32_t> image = ownerImage(alone(mesh, k));
            for (size_t i = 0; i < image.size(); ++i) owners[i] += image[i] == 0;
        }
        EXPECT_TRUE(std::ranges::all_of(owners, [](int count) { return count == 1; })) << "seed " << seed;
    }
}

TEST(Ownership, PixelCentresOnEdgesGoByTheTopLeftRule) {
    // Vertical edges through pixel centres: the piece to the right of the edge owns them.
    std::vector<PieceVertex> vertices;
    for (double y : {0.0, 3.0})
        for (double x : {0.0, 1.5, 2.5, 4.0}) vertices.push_back({{x, y, 5}, {x, y}});
    const std::vector<int32_t> owners = ownerImage(meshFromGrid({{4, 3}, 3, 1, vertices}, true));
    EXPECT_EQ(owners, (std::vector<int32_t>{0, 1, 2, 2, 0, 1, 2, 2, 0, 1, 2, 2}));
}

TEST(Ownership, MirroredPiecesOwnTheSamePixels) {
    const PieceMesh mesh = wobblyTriangles({40, 40}, 3, 5);
    PieceMesh mirrored = mesh;
    for (Piece& piece : mirrored.pieces)
        std::reverse(piece.vertices.begin(), piece.vertices.begin() + piece.vertexCount);
    EXPECT_EQ(ownerImage(mesh), ownerImage(mirrored));
}

TEST(Ownership, PixelsOutsideEveryPieceHaveNone) {
    std::vector<PieceVertex> vertices;
    for (double y : {1.0, 2.0})
        for (double x : {1.0, 3.0}) vertices.push_back({{x, y, 5}, {x, y}});
    const std::vector<int32_t> owners = ownerImage(meshFromGrid({{4, 3}, 1, 1, vertices}, true));
    EXPECT_EQ(owners, (std::vector<int32_t>{-1, -1, -1, -1, -1, 0, 0, -1, -1, -1, -1, -1}));
}

}  // namespace
}  // namespace curvewall
