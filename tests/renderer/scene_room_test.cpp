#include "renderer/scene/load_scene.h"
#include "renderer/scene/room.h"
#include "tests/renderer/scene_checks.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

namespace curvewall {
namespace {

using Point = std::tuple<float, float, float>;

Point pointOf(glm::vec3 v) { return {v.x, v.y, v.z}; }

TEST(Room, IsABoxOf8By5By8MetresAroundTheOrigin) {
    const Scene room = loadScene("room");
    test::expectSound(room);
    EXPECT_EQ(room.triangles.size(), 12u);
    EXPECT_EQ(room.originM, glm::dvec3(0));
    EXPECT_EQ(room.defaultCamera, Camera{});
    std::set<Point> corners;
    for (const glm::vec3& p : room.positions) {
        EXPECT_EQ(glm::abs(p), glm::vec3(4, 2.5f, 4));
        corners.insert(pointOf(p));
    }
    EXPECT_EQ(corners.size(), 8u);
}

TEST(Room, IsWatertight) {
    const Scene room = makeRoom();
    // In a closed surface with one orientation every directed edge has its opposite, exactly once.
    std::map<std::pair<Point, Point>, int> edges;
    for (const glm::uvec3& t : room.triangles)
        for (glm::length_t i = 0; i < 3; ++i)
            ++edges[{pointOf(room.positions[t[i]]), pointOf(room.positions[t[(i + 1) % 3]])}];
    EXPECT_EQ(edges.size(), 36u);
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_TRUE(edges.contains({edge.second, edge.first}));
    }
}

TEST(Room, LooksInwardInSixColours) {
    const Scene room = makeRoom();
    EXPECT_EQ(test::cornersAgainstWinding(room), 0u);
    for (size_t i = 0; i < room.positions.size(); ++i)
        EXPECT_LT(glm::dot(room.positions[i], room.normals[i]), 0);
    std::set<Point> colors;
    for (const Material& material : room.materials) {
        colors.insert(pointOf(glm::vec3(material.baseColor)));
        EXPECT_FALSE(material.unlit);
        EXPECT_TRUE(material.doubleSided);
        EXPECT_EQ(material.texture, -1);
    }
    EXPECT_EQ(colors.size(), 6u);
}

}  // namespace
}  // namespace curvewall
