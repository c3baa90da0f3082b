#include "calibration/pieces/ownership.h"

#include "tests/support/polygon_meshes.h"
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

// How often each pixel centre is owned when every piece owns alone.
std::vector<int> coverOf(const PieceMesh& mesh) {
    std::vector<int> cover(static_cast<size_t>(mesh.sizePx.x) * static_cast<size_t>(mesh.sizePx.y));
    for (size_t k = 0; k < mesh.pieces.size(); ++k) {
        const std::vector<int32_t> image = ownerImage(alone(mesh, k));
        for (size_t i = 0; i < image.size(); ++i) cover[i] += image[i] == 0;
    }
    return cover;
}

TEST(Ownership, PolygonsOnNoGridOwnEveryPixelOnce) {
    test::Random random(11);
    for (int i = 0; i < 30; ++i) {
        // From cells of several pixels to cells of a fraction of one.
        const test::Honeycomb honeycomb{static_cast<int>(random.uniform(2, 60)),
                                        static_cast<int>(random.uniform(2, 50)), 1, 0};
        const std::vector<int> cover = coverOf(test::honeycombMesh({41, 29}, honeycomb, random));
        EXPECT_EQ(std::ranges::count(cover, 1), 41 * 29) << "mesh " << i;
    }
}

TEST(Ownership, SliversAndEdgesWithoutALengthOwnEveryPixelOnce) {
    test::Random random(12);
    for (int i = 0; i < 30; ++i) {
        // Cells of many pixels one way and a small part of a pixel the other, some vertices at one place.
        test::Honeycomb honeycomb{3, 400, 1, 0.1};
        const glm::ivec2 sizePx(23, 19);
        PieceMesh mesh = test::honeycombMesh(sizePx, honeycomb, random);
        if (i % 2 == 1) {
            mesh.sizePx = {sizePx.y, sizePx.x};
            for (PieceVertex& vertex : mesh.vertices) vertex.s = {vertex.s.y, vertex.s.x};
        }
        for (const int32_t owner : ownerImage(mesh)) EXPECT_NE(owner, kNoPiece);
        // Rounding may turn a sliver over: then its neighbours overlap there, and the centre is owned by all
        // three.
        for (const int count : coverOf(mesh)) EXPECT_EQ(count % 2, 1);
    }
}

TEST(Ownership, AConcaveCornerWithinTheRoundingIsFilledByTheNeighbour) {
    // The corner of a hexagon lies a 1/512 px inside of the line between its neighbours, on a pixel's centre.
    PieceMesh mesh{{8, 4}, {}, {}};
    for (const glm::dvec2 s : {glm::dvec2(0, 0), {8, 0}, {8, 2.5}, {3.5, 2.501}, {0, 2.5}, {8, 4}, {0, 4}})
        mesh.vertices.push_back({{}, s});
    mesh.pieces = {{{0, 1, 2, 3, 4}, 5}, {{4, 3, 2, 5, 6}, 5}};
    const std::vector<int> cover = coverOf(mesh);
    EXPECT_EQ(std::ranges::count(cover, 1), 32);
}

TEST(Ownership, IsThatOfThePolygonsInExactArithmetic) {
    // Truth from the sides of the edges, in doubles that hold these integers exactly.
    test::Random random(13);
    const glm::ivec2 sizePx(61, 47);
    for (int i = 0; i < 10; ++i) {
        PieceMesh mesh = test::honeycombMesh(sizePx, {10, 8, 1, 0}, random);
        for (PieceVertex& vertex : mesh.vertices) vertex.s = snapToGrid(vertex.s);
        const std::vector<int32_t> owners = ownerImage(mesh);
        for (int y = 0; y < sizePx.y; ++y) {
            for (int x = 0; x < sizePx.x; ++x) {
                const int32_t owner = owners[static_cast<size_t>(y * sizePx.x + x)];
                ASSERT_NE(owner, kNoPiece);
                const Piece& piece = mesh.pieces[static_cast<size_t>(owner)];
                for (uint32_t k = 0; k < piece.vertexCount; ++k) {
                    const glm::dvec2 from = mesh.vertices[piece.vertices[k]].s;
                    const glm::dvec2 along =
                        mesh.vertices[piece.vertices[(k + 1) % piece.vertexCount]].s - from;
                    const glm::dvec2 to = glm::dvec2(x, y) + 0.5 - from;
                    ASSERT_GE(along.x * to.y - along.y * to.x, 0) << x << ", " << y;
                }
            }
        }
    }
}

TEST(Ownership, SomeRowsAndColumnsAreThoseOfTheWholeImage) {
    test::Random random(14);
    const glm::ivec2 sizePx(41, 29);
    const PieceMesh mesh = test::honeycombMesh(sizePx, {20, 17, 1, 0}, random);
    const std::vector<int32_t> whole = ownerImage(mesh);
    for (const int every : {1, 2, 3, 8, 28, 100}) {
        const int columns = 1 + (sizePx.x - 1) / every, rows = 1 + (sizePx.y - 1) / every, from = rows / 3;
        std::vector<int32_t> some(static_cast<size_t>((rows - from) * columns));
        Ownership(mesh).fillRows(from, rows, every, some);
        for (int y = from; y < rows; ++y)
            for (int x = 0; x < columns; ++x)
                EXPECT_EQ(some[static_cast<size_t>((y - from) * columns + x)],
                          whole[static_cast<size_t>(y * every * sizePx.x + x * every)]);
    }
}

}  // namespace
}  // namespace curvewall
