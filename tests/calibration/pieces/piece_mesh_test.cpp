#include "calibration/pieces/piece_mesh.h"

#include "calibration/pieces/piece_fit.h"
#include "tests/support/polygon_meshes.h"
#include "tests/support/random_numbers.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace curvewall {
namespace {

glm::dvec2 land(const Piece& piece, glm::dvec3 ray) {
    const glm::dvec3 h = piece.screenFromRay * ray;
    return glm::dvec2(h) / h.z;
}

TEST(PieceMesh, VerticesLandOnTheirScreenPositions) {
    test::Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const auto vertex = [&] {
            return PieceVertex{random.inBox(1) + glm::dvec3(0, 0, -3), random.pixel({999, 999})};
        };
        const std::array<PieceVertex, 3> v{vertex(), vertex(), vertex()};
        const glm::dmat3 h = homographyThrough(v[0], v[1], v[2]);
        for (const PieceVertex& p : v) EXPECT_LT(glm::distance(h * p.m, glm::dvec3(p.s, 1)), 1e-6);
    }
}

TEST(PieceMesh, AParallelogramIsAnExactQuadAndAnythingElseIsNot) {
    const auto corner = [](double x, double y) {
        return PieceVertex{{x, y, -2 + 0.3 * x}, {100 * x, 50 * y}};
    };
    std::array<PieceVertex, 4> v{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
    EXPECT_TRUE(isExactQuad(v[0], v[1], v[2], v[3]));
    v[3].m.z += 1e-6;  // out of the plane
    EXPECT_FALSE(isExactQuad(v[0], v[1], v[2], v[3]));
    v[3].m = corner(0, 1 + 1e-6).m;  // in the plane, but no parallelogram
    EXPECT_FALSE(isExactQuad(v[0], v[1], v[2], v[3]));
}

TEST(PieceMesh, NeighboursAgreeAlongTheirSharedEdge) {
    // Continuity is a property of the construction: any m will do, the fitted ones included.
    const Wall wall = test::fullCylinderWall({1600, 1200}, {1.1, 0.4, -0.6});
    const FittedPieces fitted = fitPieces(*wall.displays[0].projection, {1600, 1200}, 0.25);
    const PieceMesh& mesh = fitted.mesh;
    int sharedEdges = 0;
    for (size_t k = 0; k + 1 < mesh.pieces.size(); ++k) {
        const Piece &left = mesh.pieces[k], &right = mesh.pieces[k + 1];
        if (left.vertices[1] != right.vertices[0] || left.vertices[2] != right.vertices[3]) continue;
        ++sharedEdges;
        for (double t : {0.0, 0.2, 0.5, 0.9, 1.0}) {
            const glm::dvec3 ray =
                glm::mix(mesh.vertices[left.vertices[1]].m, mesh.vertices[left.vertices[2]].m, t);
            EXPECT_LT(glm::distance(land(left, ray), land(right, ray)), 1e-9);
        }
    }
    EXPECT_GT(sharedEdges, 70);
}

TEST(PieceMesh, EdgePlanesHoldThePieceAndItsGuardAndNoMore) {
    const Wall wall = test::fullCylinderWall({1600, 1200});
    const PieceMesh mesh = fitPieces(*wall.displays[0].projection, {1600, 1200}, 1).mesh;
    for (const Piece& piece : mesh.pieces) {
        const glm::dmat3 rayFromScreen = glm::inverse(piece.screenFromRay);
        const glm::dvec2 least = mesh.vertices[piece.vertices[0]].s,
                         most = mesh.vertices[piece.vertices[2]].s;
        const auto inside = [&](glm::dvec2 px) {
            for (const glm::dvec3& plane : edgePlanes(mesh, piece))
                if (glm::dot(plane, rayFromScreen * glm::dvec3(px, 1)) < 0) return false;
            return true;
        };
        const glm::dvec2 middle = 0.5 * (least + most);
        EXPECT_TRUE(inside(middle));
        EXPECT_TRUE(inside({least.x - 0.99 * kGuardPx, middle.y}));
        EXPECT_TRUE(inside({middle.x, most.y + 0.99 * kGuardPx}));
        EXPECT_FALSE(inside({least.x - 1.01 * kGuardPx, middle.y}));
        EXPECT_FALSE(inside({most.x + 1.01 * kGuardPx, middle.y}));
        EXPECT_FALSE(inside({middle.x, least.y - 1.01 * kGuardPx}));
    }
}

// Pieces of three to six edges, some of them with corners in one line, on a flat display.
PieceMesh honeycomb(glm::ivec2 sizePx, uint64_t seed) {
    test::Random random(seed);
    const Wall wall = test::planarWall(sizePx, 100);
    return test::honeycombOn(*wall.displays[0].projection, sizePx, {10, 8, 1, 0}, random);
}

TEST(PieceMesh, PolygonsLandEveryVertexOnItsScreenPosition) {
    for (uint64_t seed = 1; seed <= 20; ++seed) {
        const PieceMesh mesh = honeycomb({640, 480}, seed);
        std::array<int, kMostPieceEdges + 1> counts{};
        for (const Piece& piece : mesh.pieces) {
            ++counts.at(piece.vertexCount);
            for (uint32_t i = 0; i < piece.vertexCount; ++i) {
                const PieceVertex& vertex = mesh.vertices[piece.vertices[i]];
                EXPECT_LT(glm::distance(land(piece, vertex.m), vertex.s), 1e-9);
            }
        }
        for (size_t edges = 3; edges <= kMostPieceEdges; ++edges) EXPECT_GT(counts.at(edges), 0) << edges;
    }
}

TEST(PieceMesh, EdgePlanesHoldPolygonsAndTheirGuardAndNoMore) {
    for (uint64_t seed = 1; seed <= 20; ++seed) {
        const PieceMesh mesh = honeycomb({640, 480}, seed);
        for (const Piece& piece : mesh.pieces) {
            const std::vector<glm::dvec3> planes = edgePlanes(mesh, piece);
            ASSERT_EQ(planes.size(), piece.vertexCount);
            const glm::dmat3 rayFromScreen = glm::inverse(piece.screenFromRay);
            const auto inside = [&](glm::dvec2 px) {
                return std::ranges::all_of(planes, [&](const glm::dvec3& plane) {
                    return glm::dot(plane, rayFromScreen * glm::dvec3(px, 1)) >= 0;
                });
            };
            for (uint32_t i = 0; i < piece.vertexCount; ++i) {
                const glm::dvec2 from = mesh.vertices[piece.vertices[i]].s;
                const glm::dvec2 to = mesh.vertices[piece.vertices[(i + 1) % piece.vertexCount]].s;
                const glm::dvec2 along = glm::normalize(to - from), outward(along.y, -along.x);
                const glm::dvec2 middle = glm::mix(from, to, 0.5);
                EXPECT_TRUE(inside(middle + 0.99 * kGuardPx * outward));
                EXPECT_FALSE(inside(middle + 1.01 * kGuardPx * outward));
            }
        }
    }
}

TEST(PieceMesh, GuardedCornersLieOnTheGuardOfBothTheirEdges) {
    for (uint64_t seed = 1; seed <= 20; ++seed) {
        const PieceMesh mesh = honeycomb({640, 480}, seed);
        for (const Piece& piece : mesh.pieces) {
            const std::vector<glm::dvec3> corners = guardedCorners(mesh, piece);
            ASSERT_EQ(corners.size(), piece.vertexCount);
            for (uint32_t i = 0; i < piece.vertexCount; ++i) {
                const auto s = [&](uint32_t k) {
                    return mesh.vertices[piece.vertices[k % piece.vertexCount]].s;
                };
                for (const uint32_t edge : {i + piece.vertexCount - 1, i}) {
                    const glm::dvec2 along = glm::normalize(s(edge + 1) - s(edge));
                    const glm::dvec2 off = land(piece, corners[i]) - s(edge);
                    EXPECT_NEAR(along.y * off.x - along.x * off.y, kGuardPx, 1e-7);
                }
            }
        }
    }
}

TEST(PieceMesh, EdgesWithoutALengthBoundNothing) {
    PieceMesh mesh = honeycomb({640, 480}, 3);
    for (Piece& piece : mesh.pieces) {
        if (piece.vertexCount == kMostPieceEdges) continue;
        const std::vector<glm::dvec3> planes = edgePlanes(mesh, piece), corners = guardedCorners(mesh, piece);
        // The last vertex once more, a rounding away.
        PieceVertex twice = mesh.vertices[piece.vertices[piece.vertexCount - 1]];
        twice.s.x += 1e-12;
        piece.vertices.at(piece.vertexCount++) = static_cast<uint32_t>(mesh.vertices.size());
        mesh.vertices.push_back(twice);
        const std::vector<glm::dvec3> same = edgePlanes(mesh, piece),
                                      sameCorners = guardedCorners(mesh, piece);
        ASSERT_EQ(same.size(), planes.size());
        ASSERT_EQ(sameCorners.size(), corners.size());
        for (size_t i = 0; i < planes.size(); ++i) {
            EXPECT_LT(glm::distance(same[i], planes[i]), 1e-9 * glm::length(planes[i]));
            EXPECT_LT(glm::distance(sameCorners[i], corners[i]), 1e-9 * glm::length(corners[i]));
        }
    }
}

}  // namespace
}  // namespace curvewall
