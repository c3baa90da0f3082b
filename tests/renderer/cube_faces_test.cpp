#include "renderer/cube_faces.h"

#include "tests/support/random_numbers.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <gtest/gtest.h>

namespace curvewall {
namespace {

TEST(CubeFaces, PositionsAndRaysAreInverse) {
    test::Random random(1);
    for (int i = 0; i < 10'000; ++i) {
        const glm::dvec3 ray = random.direction();
        const int face = cubeFaceOf(ray);
        const glm::dvec2 position = cubeFacePosition(ray, face);
        EXPECT_GE(std::min(position.x, position.y), -1e-7);
        EXPECT_LE(std::max(position.x, position.y), 1 + 1e-7);
        EXPECT_LT(glm::distance(glm::normalize(cubeFaceRay(position, face)), ray), 1e-12);
    }
}

TEST(CubeFaces, AxesAreThoseOfTheOpenGlSpecification) {
    // Specification 4.5, table 8.19: +x has s along -z and t along -y.
    EXPECT_EQ(cubeFaceOf({1, 0, 0}), 0);
    EXPECT_EQ(cubeFaceOf({0, -1, 0}), 3);
    EXPECT_EQ(cubeFaceOf({0, 0, -1}), 5);
    EXPECT_EQ(cubeFacePosition({1, 0, -0.5}, 0), glm::dvec2(0.75, 0.5));
    EXPECT_EQ(cubeFacePosition({1, 0.5, 0}, 0), glm::dvec2(0.5, 0.25));
    EXPECT_EQ(cubeFacePosition({0.5, 1, 0}, 2), glm::dvec2(0.75, 0.5));
    EXPECT_EQ(cubeFacePosition({0, 1, 0.5}, 2), glm::dvec2(0.5, 0.75));
    EXPECT_EQ(cubeFacePosition({0, 0.5, -1}, 5), glm::dvec2(0.5, 0.25));
}

TEST(CubeFaces, TheMeshOfAFaceShowsTheSameAsItsTexels) {
    test::Random random(2);
    for (int face = 0; face < 6; ++face) {
        const PieceMesh mesh = cubeFaceMesh(face, 256, 2.5);
        ASSERT_EQ(mesh.pieces.size(), 1u);
        for (int i = 0; i < 100; ++i) {
            const glm::dvec2 position(random.uniform(0, 1), random.uniform(0, 1));
            const glm::dvec3 seen = mesh.pieces[0].screenFromRay * cubeFaceRay(position, face);
            EXPECT_GT(seen.z, 0);
            EXPECT_LT(glm::distance(glm::dvec2(seen) / seen.z, 256.0 * position), 1e-9);
        }
    }
}

TEST(CubeFaces, ErrorFallsWithTheFaceSize) {
    const Wall wall = test::fullCylinderWall({400, 300});
    const auto rays = displayRays(wall.displays[0]);
    const double coarse = cubeError(wall.displays[0], rays, 256).maxPx,
                 fine = cubeError(wall.displays[0], rays, 1024).maxPx;
    EXPECT_NEAR(coarse / fine, 4, 0.4);
}

}  // namespace
}  // namespace curvewall
