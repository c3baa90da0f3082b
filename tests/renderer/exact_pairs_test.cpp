// The counter of exact pairs against a brute force of another kind: a plane that separates two cones.

#include "tests/support/exact_pairs.h"

#include "calibration/pieces/piece_fit.h"
#include "tests/support/polygon_meshes.h"
#include "tests/support/random_numbers.h"
#include "tests/support/shipped_walls.h"
#include "tests/support/test_scenes.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace curvewall {
namespace {

using test::ExactPairCounter;
using test::ExactPairs;

// Pointed convex cones have no inside in common exactly where a plane separates them, and if any does, then
// one through two of their corner rays.
bool haveSeparatingPlane(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
    std::vector<glm::dvec3> all = a;
    all.insert(all.end(), b.begin(), b.end());
    for (size_t i = 0; i < all.size(); ++i) {
        for (size_t k = 0; k < all.size(); ++k) {
            const glm::dvec3 plane = glm::cross(all[i], all[k]);
            // What spans the plane is in it, whatever rounding says.
            const auto aside = [&](size_t n) { return n == i || n == k ? 0 : glm::dot(plane, all[n]); };
            bool separates = glm::length(plane) > 1e-12 * glm::length(all[i]) * glm::length(all[k]);
            for (size_t n = 0; n < all.size(); ++n) separates &= n < a.size() ? aside(n) >= 0 : aside(n) <= 0;
            if (separates) return true;
        }
    }
    return false;
}

ExactPairs bruteForce(const Scene& scene, const PieceMesh& mesh, const Camera& camera, glm::dvec3 eyeM) {
    const glm::dmat3 sceneFromWall = rotationFromOrientation(camera.orientation);
    const glm::dvec3 eye = camera.positionM + sceneFromWall * eyeM;
    ExactPairs found;
    for (const MaterialRange& range : scene.ranges) {
        for (uint32_t i = range.firstTriangle; i < range.firstTriangle + range.triangleCount; ++i) {
            const auto corner = [&](int k) {
                const glm::dvec3 place(scene.positions[scene.triangles[i][k]]);
                return glm::inverse(sceneFromWall) * (scene.originM + place - eye);
            };
            const std::vector<glm::dvec3> corners{corner(0), corner(1), corner(2)};
            const double volume = glm::determinant(glm::dmat3(corners[0], corners[1], corners[2]));
            if (volume > 0 && !scene.materials[range.material].doubleSided) continue;
            uint64_t pieces = 0;
            for (const Piece& piece : mesh.pieces) {
                std::vector<glm::dvec3> cone;
                for (uint32_t k = 0; k < piece.vertexCount; ++k)
                    cone.push_back(mesh.vertices[piece.vertices[k]].m);
                pieces += !haveSeparatingPlane(cone, corners);
            }
            found.pairs += pieces;
            found.triangles += pieces > 0;
        }
    }
    return found;
}

// Near and far, small and large, in front of the eye, behind it and across.
Scene anyTriangles(size_t count, test::Random& random) {
    Scene scene;
    scene.originM = {30, -20, 10};
    for (const bool doubleSided : {false, true}) {
        Material material;
        material.doubleSided = doubleSided;
        startMaterial(scene, material);
        for (size_t i = 0; i < count / 2; ++i) {
            const glm::dvec3 place = random.inBox(4);
            const double size = i % 3 == 0 ? 8 : i % 3 == 1 ? 1 : 0.1;
            addTriangle(scene, {glm::vec3(place), glm::vec3(place + random.inBox(size)),
                                glm::vec3(place + random.inBox(size))});
        }
    }
    return scene;
}

void expectBruteForce(const PieceMesh& mesh, size_t triangles, uint64_t seed) {
    test::Random random(seed);
    const Scene scene = anyTriangles(triangles, random);
    const glm::dvec3 eyeM(0.1, 0.2, -0.3);
    const Camera camera{scene.originM + random.inBox(0.5), {1.1, -0.4, 0.3}};
    const ExactPairs exact = ExactPairCounter(scene, mesh).count(camera, eyeM);
    const ExactPairs expected = bruteForce(scene, mesh, camera, eyeM);
    EXPECT_EQ(exact.pairs, expected.pairs);
    EXPECT_EQ(exact.triangles, expected.triangles);
    EXPECT_GT(exact.pairs, triangles / 4);
}

TEST(ExactPairs, AreThoseThatNoPlaneSeparates) {
    const Wall cylinder = test::fullCylinderWall({400, 300});
    expectBruteForce(fitPieces(cylinder.displays[0], 0.5).mesh, 2000, 1);
    expectBruteForce(fitPieces(test::shippedWall("dome-master").displays[0], 20).mesh, 1000, 2);

    const Wall planar = test::planarWall({400, 300}, 110);
    test::Random random(3);
    expectBruteForce(test::honeycombOn(*planar.displays[0].projection, {400, 300}, {8, 6, 1, 0.1}, random),
                     1000, 4);
}

class OnFlatGrid : public testing::Test {
protected:
    // A screen from -1 to 1 at distance one, in 4 x 4 quads; y goes down on the screen.
    static PieceMesh grid() {
        PieceGrid grid{{400, 400}, 4, 4, {}};
        for (int y = 0; y <= 4; ++y)
            for (int x = 0; x <= 4; ++x)
                grid.vertices.push_back({{x * 0.5 - 1, 1 - y * 0.5, -1}, {x * 100.0, y * 100.0}});
        return meshFromGrid(grid, true);
    }

    static ExactPairs countOf(const std::array<glm::vec3, 3>& corners, bool doubleSided = false) {
        Scene scene;
        Material material;
        material.doubleSided = doubleSided;
        startMaterial(scene, material);
        addTriangle(scene, corners);
        const PieceMesh mesh = grid();
        return ExactPairCounter(scene, mesh).count({}, {});
    }
};

TEST_F(OnFlatGrid, CountsByHand) {
    const auto pairs = [](const std::array<glm::vec3, 3>& corners) { return countOf(corners).pairs; };
    EXPECT_EQ(pairs({glm::vec3(0.1f, 0.1f, -1), {0.4f, 0.1f, -1}, {0.1f, 0.4f, -1}}), 1u);
    // The triangle that is half of the screen: ten of the sixteen quads.
    EXPECT_EQ(pairs({glm::vec3(-2, -2, -2), {2, -2, -2}, {-2, 2, -2}}), 10u);
    EXPECT_EQ(pairs({glm::vec3(-90, -90, -9), {90, -90, -9}, {0, 90, -9}}), 16u);
    // Along an edge of quads, from both sides.
    EXPECT_EQ(pairs({glm::vec3(0, 0, -1), {0.4f, 0, -1}, {0, 0.4f, -1}}), 1u);
    EXPECT_EQ(pairs({glm::vec3(-0.01f, -0.01f, -1), {0.4f, 0, -1}, {0, 0.4f, -1}}), 4u);
    // Beside the screen, and behind the eye.
    EXPECT_EQ(pairs({glm::vec3(1.01f, 0, -1), {1.4f, 0, -1}, {1.01f, 0.4f, -1}}), 0u);
    EXPECT_EQ(pairs({glm::vec3(-0.1f, -0.1f, 1), {0.4f, -0.1f, 1}, {0.1f, 0.4f, 1}}), 0u);
    // A floor from behind the eye to ahead of it fills the quads below the horizon that lie within it.
    EXPECT_EQ(pairs({glm::vec3(-99, -0.5f, 50), {99, -0.5f, 50}, {0, -0.5f, -50}}), 8u);
    // Seen edge-on.
    EXPECT_EQ(pairs({glm::vec3(0, 0, -1), {0, 0, -3}, {0, 1, -3}}), 0u);
}

TEST_F(OnFlatGrid, BacksCountWhereTheyAreDrawn) {
    const std::array<glm::vec3, 3> back{glm::vec3(0.1f, 0.1f, -1), {0.1f, 0.4f, -1}, {0.4f, 0.1f, -1}};
    EXPECT_EQ(countOf(back, false).pairs, 0u);
    EXPECT_EQ(countOf(back, true).pairs, 1u);
    EXPECT_EQ(countOf(back, true).triangles, 1u);
}

}  // namespace
}  // namespace curvewall
