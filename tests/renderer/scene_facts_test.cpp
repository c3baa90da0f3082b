#include "renderer/scene_facts.h"

#include "renderer/scene/load_scene.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

#include <cmath>

namespace curvewall {
namespace {

SceneFacts factsFor(const Scene& scene, const Wall& wall) {
    return factsOf(scene, sceneViewOf(scene.defaultCamera, wall.eyeM, scene), factsOf(wall.displays.front()));
}

// Whoever stands in a closed room sees one wall in every direction.
TEST(SceneFacts, ARoomIsOneFragmentDeepAllAround) {
    const Scene room = loadScene("room");
    const SceneFacts facts = factsFor(room, test::fullCylinderWall({1600, 1200}));
    EXPECT_EQ(facts.seenTriangles, facts.triangles);
    EXPECT_NEAR(facts.fragmentsAPixel, 1, 1e-6);
}

TEST(SceneFacts, ANarrowDisplaySeesAPartOfIt) {
    const Scene room = loadScene("room");
    const SceneFacts facts = factsFor(room, test::planarWall({800, 600}, 40));
    EXPECT_LT(facts.seenTriangles, facts.triangles);
    EXPECT_GT(facts.seenTriangles, 0);
    EXPECT_NEAR(facts.fragmentsAPixel, 1, 0.35);
}

TEST(SceneFacts, OfALargeSceneAreThoseOfSomeOfItsTriangles) {
    Scene city = loadScene("city:100000");
    const Wall wall = test::fullCylinderWall({1600, 1200});
    const SceneFacts once = factsFor(city, wall);
    // The same triangles five times over are 500,000, of which every third is looked at.
    const std::vector<glm::uvec3> triangles = city.triangles;
    for (int i = 0; i < 4; ++i)
        city.triangles.insert(city.triangles.end(), triangles.begin(), triangles.end());
    const SceneFacts five = factsFor(city, wall);
    EXPECT_NEAR(five.seenTriangles, 5 * once.seenTriangles, 0.02 * five.seenTriangles);
    EXPECT_NEAR(five.fragmentsAPixel, 5 * once.fragmentsAPixel, 0.1 * five.fragmentsAPixel);
    EXPECT_NEAR(five.squaredEdgesPx2, 5 * once.squaredEdgesPx2, 0.2 * five.squaredEdgesPx2);
}

}  // namespace
}  // namespace curvewall
