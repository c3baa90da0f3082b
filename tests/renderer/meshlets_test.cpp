#include "renderer/meshlets.h"

#include "renderer/scene/load_scene.h"
#include "tests/support/random_numbers.h"
#include "tests/support/test_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

namespace curvewall {
namespace {

constexpr double kPi = std::numbers::pi;

// A ball of quads cut in two, as soup: no two triangles share an index.
Scene sphereSoup(glm::vec3 centreM, float radiusM, int columns, int rows) {
    Scene scene;
    startMaterial(scene, plainMaterial(glm::vec3(1)));
    const auto point = [&](int column, int row) {
        const double turn = 2 * kPi * (column % columns) / columns, down = kPi * row / rows;
        return centreM + radiusM * glm::vec3(std::sin(down) * std::cos(turn), std::cos(down),
                                             -std::sin(down) * std::sin(turn));
    };
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const glm::vec3 a = point(column, row), b = point(column, row + 1),
                            c = point(column + 1, row + 1), d = point(column + 1, row);
            if (row + 1 < rows) addTriangle(scene, {a, b, c});
            if (row > 0) addTriangle(scene, {a, c, d});
        }
    }
    return scene;
}

// Triangles of any shape and facing, apart from each other.
Scene confetti(size_t triangles, test::Random& random) {
    Scene scene;
    startMaterial(scene, plainMaterial(glm::vec3(1)));
    for (size_t i = 0; i < triangles; ++i) {
        const glm::dvec3 place = random.inBox(10);
        addTriangle(scene, {glm::vec3(place), glm::vec3(place + random.inBox(1)),
                            glm::vec3(place + random.inBox(1))});
    }
    return scene;
}

// A rough plate that bends a little: cones that are neither flat nor wide.
Scene roughPlate(int cells, test::Random& random) {
    Scene scene;
    startMaterial(scene, plainMaterial(glm::vec3(1)));
    const auto side = static_cast<size_t>(cells) + 1;
    std::vector<float> heights(side * side);
    for (float& height : heights) height = static_cast<float>(random.uniform(0, 0.4));
    const auto point = [&](int x, int y) {
        return glm::vec3(x, y,
                         heights[static_cast<size_t>(y) * side + static_cast<size_t>(x)] -
                             0.01f * static_cast<float>(x * x));
    };
    for (int y = 0; y < cells; ++y)
        for (int x = 0; x < cells; ++x)
            addQuad(scene, {point(x, y), point(x + 1, y), point(x + 1, y + 1), point(x, y + 1)});
    return scene;
}

std::span<const glm::uvec3> trianglesOf(const Scene& scene, const MaterialRange& range) {
    return std::span(scene.triangles).subspan(range.firstTriangle, range.triangleCount);
}

Meshlets cutAll(const Scene& scene) { return cutIntoMeshlets(scene.positions, scene.triangles); }

void expectSound(const Meshlets& cut, std::span<const glm::vec3> positions,
                 std::span<const glm::uvec3> triangles, uint32_t mostTriangles) {
    std::vector<uint32_t> sorted = cut.order, all(triangles.size());
    std::ranges::sort(sorted);
    std::iota(all.begin(), all.end(), 0u);
    ASSERT_EQ(sorted, all);
    uint32_t next = 0, outside = 0;
    for (const Meshlet& meshlet : cut.meshlets) {
        ASSERT_EQ(meshlet.firstTriangle, next);
        ASSERT_GT(meshlet.triangleCount, 0u);
        ASSERT_LE(meshlet.triangleCount, mostTriangles);
        next += meshlet.triangleCount;
        for (uint32_t i = meshlet.firstTriangle; i < next; ++i)
            for (int corner = 0; corner < 3; ++corner)
                outside += glm::distance(glm::dvec3(positions[triangles[cut.order[i]][corner]]),
                                         glm::dvec3(meshlet.centreM)) > static_cast<double>(meshlet.radiusM);
    }
    EXPECT_EQ(next, triangles.size());
    EXPECT_EQ(outside, 0u);
}

bool isFront(const Scene& scene, uint32_t triangle, glm::dvec3 eyeM) {
    const glm::uvec3 t = scene.triangles[triangle];
    const glm::dvec3 a(scene.positions[t.x]), b(scene.positions[t.y]), c(scene.positions[t.z]);
    return glm::dot(glm::cross(b - a, c - a), eyeM - a) > 0;
}

struct Culled {
    uint32_t meshlets = 0;  // over all eyes
    uint32_t wrongly = 0;   // with a triangle whose front is seen
};

Culled cullFrom(const Scene& scene, const std::vector<glm::vec3>& eyesM) {
    const Meshlets cut = cutAll(scene);
    Culled culled;
    for (const glm::vec3 eyeM : eyesM) {
        for (const Meshlet& meshlet : cut.meshlets) {
            if (!isBehind(meshlet, eyeM)) continue;
            ++culled.meshlets;
            const auto first = cut.order.begin() + meshlet.firstTriangle;
            culled.wrongly += std::any_of(first, first + meshlet.triangleCount,
                                          [&](uint32_t t) { return isFront(scene, t, glm::dvec3(eyeM)); });
        }
    }
    return culled;
}

std::vector<glm::vec3> anyEyes(size_t count, glm::dvec3 middleM, double halfSizeM, test::Random& random) {
    std::vector<glm::vec3> eyes(count);
    std::ranges::generate(eyes, [&] { return glm::vec3(middleM + random.inBox(halfSizeM)); });
    return eyes;
}

TEST(Meshlets, HaveEveryTriangleOnceAtAnyScale) {
    for (const float scale : {1e-30f, 1e-18f, 1.0f, 1e18f, 1e30f, 1e37f}) {
        test::Random random(3);
        Scene scene = confetti(1000, random);
        for (glm::vec3& position : scene.positions) position *= scale;
        Meshlets cut = cutIntoMeshlets(scene.positions, scene.triangles);
        std::ranges::sort(cut.order);
        ASSERT_EQ(cut.order.size(), scene.triangles.size()) << scale;
        for (size_t i = 0; i < cut.order.size(); ++i) ASSERT_EQ(cut.order[i], i) << scale;
    }
}

TEST(Meshlets, HoldEveryTriangleOnceAndEveryVertex) {
    test::Random random(1);
    std::vector<Scene> scenes{loadScene("room"), loadScene("city:5000"), confetti(777, random),
                              sphereSoup({1, 2, 3}, 2, 40, 20)};
    for (const Scene& scene : scenes) {
        SCOPED_TRACE(scene.name);
        for (const MaterialRange& range : scene.ranges) {
            for (const uint32_t most : {4u, kMeshletTriangles, 512u}) {
                const auto triangles = trianglesOf(scene, range);
                expectSound(cutIntoMeshlets(scene.positions, triangles, most), scene.positions, triangles,
                            most);
            }
        }
    }
}

TEST(Meshlets, NoTrianglesAreNoMeshlets) {
    const Meshlets cut = cutIntoMeshlets({}, {});
    EXPECT_TRUE(cut.order.empty());
    EXPECT_TRUE(cut.meshlets.empty());
}

TEST(Meshlets, EqualAndFlattenedTrianglesAreAllKept) {
    const std::vector<glm::vec3> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {-0.0f, 0, 0}};
    std::vector<glm::uvec3> triangles(100, {0, 1, 2});
    triangles.insert(triangles.end(), 30, {4, 1, 2});  // the same place
    triangles.insert(triangles.end(), 10, {0, 1, 3});  // in one line
    triangles.insert(triangles.end(), 10, {1, 1, 1});
    expectSound(cutIntoMeshlets(positions, triangles), positions, triangles, kMeshletTriangles);
}

TEST(Meshlets, AreFullAndSmall) {
    // Soup is put together again: patches of a ball of radius 10, each a 64th of it or little more.
    const Scene ball = sphereSoup({0, 0, 0}, 10, 64, 33);
    ASSERT_EQ(ball.triangles.size(), 64u * 64);
    const Meshlets cut = cutAll(ball);
    EXPECT_LE(cut.meshlets.size(), 66u);
    double sum = 0;
    for (const Meshlet& meshlet : cut.meshlets) sum += static_cast<double>(meshlet.radiusM);
    // A round patch of that area has a radius of 2.5.
    EXPECT_LT(sum / static_cast<double>(cut.meshlets.size()), 4.5);
}

TEST(Meshlets, KeepSceneOrderWhereTheyCan) {
    const Scene scene = loadScene("city:20000");
    const Meshlets cut = cutAll(scene);
    uint32_t before = 0;
    for (const Meshlet& meshlet : cut.meshlets) {
        const auto first = cut.order.begin() + meshlet.firstTriangle;
        EXPECT_TRUE(std::is_sorted(first, first + meshlet.triangleCount));
        EXPECT_TRUE(meshlet.firstTriangle == 0 || *first > before);
        before = *first;
    }
}

TEST(Meshlets, ConesNeverHideAFront) {
    test::Random random(2);
    const Scene room = loadScene("room"), pieces = confetti(640, random), plate = roughPlate(24, random),
                ball = sphereSoup({5, -3, 2}, 4, 40, 20);
    EXPECT_EQ(cullFrom(room, anyEyes(10'000, {}, 10, random)).wrongly, 0u);
    EXPECT_EQ(cullFrom(pieces, anyEyes(10'000, {}, 20, random)).wrongly, 0u);
    EXPECT_EQ(cullFrom(ball, anyEyes(10'000, {5, -3, 2}, 12, random)).wrongly, 0u);
    const Culled onPlate = cullFrom(plate, anyEyes(10'000, {12, 12, 0}, 20, random));
    EXPECT_EQ(onPlate.wrongly, 0u);
    EXPECT_GT(onPlate.meshlets, 10'000u);
}

TEST(Meshlets, ConesLeaveOutTheFarSideOfABall) {
    test::Random random(3);
    const Scene ball = sphereSoup({0, 0, 0}, 1, 64, 33);
    const size_t meshlets = cutAll(ball).meshlets.size();
    std::vector<glm::vec3> eyes(1000);
    std::ranges::generate(eyes, [&] { return glm::vec3(1000.0 * random.direction()); });
    const Culled culled = cullFrom(ball, eyes);
    // Half of it, but for the meshlets that the outline passes through.
    EXPECT_GT(culled.meshlets, 1000 * meshlets / 4);
    EXPECT_EQ(culled.wrongly, 0u);
}

TEST(Meshlets, AWallIsLeftOutFromAllBehindIt) {
    Scene scene;
    startMaterial(scene, plainMaterial(glm::vec3(1)));
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 8; ++x) addFrontalSquare(scene, glm::vec3(x, y, -7), 1);
    const Meshlets cut = cutAll(scene);
    ASSERT_EQ(cut.meshlets.size(), 1u);
    EXPECT_TRUE(isBehind(cut.meshlets[0], {3, 2, -7.01f}));
    EXPECT_TRUE(isBehind(cut.meshlets[0], {900, 2, -7.01f}));
    EXPECT_FALSE(isBehind(cut.meshlets[0], {3, 2, -7}));
    EXPECT_FALSE(isBehind(cut.meshlets[0], {3, 2, -6.99f}));
}

}  // namespace
}  // namespace curvewall
