#include "renderer/edge_neighbours.h"

#include "tests/support/test_scenes.h"

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

std::vector<EdgeNeighbour> neighboursIn(const Scene& scene) {
    return edgeNeighbours(scene.positions, scene.triangles);
}

Scene withoutTriangles() {
    Scene scene;
    startMaterial(scene, plainMaterial(glm::vec3(1)));
    return scene;
}

// Two triangles over the edge from (0, 0, 0) to (0, 1, 0), the second turned up by an angle.
Scene hinge(double angleDeg) {
    Scene scene = withoutTriangles();
    const double angle = glm::radians(angleDeg);
    addTriangle(scene, {glm::vec3(-1, 0, 0), glm::vec3(0, 0, 0), glm::vec3(0, 1, 0)});
    addTriangle(scene,
                {glm::vec3(0, 0, 0), glm::vec3(std::cos(angle), 0.5, std::sin(angle)), glm::vec3(0, 1, 0)});
    return scene;
}

TEST(EdgeNeighbours, ABoxOfUnsharedVerticesIsClosedAndFoldsAtItsTwelveEdges) {
    const Scene box = boxRoom({8, 5, 6});
    const std::vector<EdgeNeighbour> neighbours = neighboursIn(box);
    ASSERT_EQ(neighbours.size(), 36u);
    EXPECT_TRUE(std::ranges::all_of(neighbours, &EdgeNeighbour::exists));
    EXPECT_EQ(std::ranges::count_if(neighbours, &EdgeNeighbour::isCrease), 2 * 12);
}

TEST(EdgeNeighbours, NameTheCornerOffTheEdge) {
    const Scene scene = hinge(0);
    const std::vector<EdgeNeighbour> neighbours = neighboursIn(scene);
    for (size_t edge = 0; edge < 6; ++edge) {
        // The shared edge lies opposite the first triangle's corner 0 and the second's corner 1.
        const bool shared = edge == 0 || edge == 4;
        ASSERT_EQ(neighbours[edge].exists(), shared) << edge;
        if (shared) {
            EXPECT_EQ(neighbours[edge].corner, edge == 0 ? 4u : 0u);
            EXPECT_FALSE(neighbours[edge].isCrease);
        }
    }
}

TEST(EdgeNeighbours, FoldsBeyondTheLeastAngleAreCreasesWhicheverWayTrianglesTurn) {
    for (const double angleDeg : {-170.0, -40.0, -30.0, 0.0, 30.0, 40.0, 90.0, 179.0})
        for (const bool turned : {false, true}) {
            Scene scene = hinge(angleDeg);
            if (turned) std::swap(scene.triangles[1].x, scene.triangles[1].z);
            EXPECT_EQ(neighboursIn(scene)[0].isCrease, std::abs(angleDeg) > kLeastCreaseDeg) << angleDeg;
        }
}

TEST(EdgeNeighbours, WhereSeveralMeetTheSurfaceGoesOnWithTheFlattest) {
    Scene scene = hinge(10);  // and one that stands upright on the edge, and one that lies on the first
    addTriangle(scene, {glm::vec3(0, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0.1, 0.5, 1)});
    addTriangle(scene, {glm::vec3(0, 1, 0), glm::vec3(0, 0, 0), glm::vec3(-1, 0, 0)});
    EXPECT_EQ(neighboursIn(scene)[0].corner, 4u);
    EXPECT_FALSE(neighboursIn(scene)[0].isCrease);
}

TEST(EdgeNeighbours, AnEdgeOfThousandsIsLeftAlone) {
    Scene scene = withoutTriangles();
    for (int i = 0; i < 20000; ++i) {
        const double angle = glm::two_pi<double>() * i / 20000;
        addTriangle(scene,
                    {glm::vec3(0, 0, 0), glm::vec3(0, 1, 0), glm::vec3(std::cos(angle), 0, std::sin(angle))});
    }
    EXPECT_FALSE(neighboursIn(scene)[2].exists());
}

TEST(EdgeNeighbours, NoTrianglesHaveNone) { EXPECT_TRUE(neighboursIn(Scene()).empty()); }

}  // namespace
}  // namespace curvewall
