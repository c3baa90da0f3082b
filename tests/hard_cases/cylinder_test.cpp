// Geometry that breaks projections, each against the reference on the full cylinder.

#include "renderer/scene/load_scene.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/random_numbers.h"
#include "tests/support/rendering.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_scenes.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

namespace curvewall {
namespace {

using test::kPi;
constexpr glm::ivec2 kSizePx(800, 600);
using Triangle = std::array<glm::vec3, 3>;

Scene coloured(const std::vector<Triangle>& triangles) {
    Scene scene;
    for (size_t i = 0; i < triangles.size(); ++i) {
        startMaterial(scene, plainMaterial({0.2 + 0.15 * double(i % 6), 0.9 - 0.13 * double(i % 7),
                                            0.3 + 0.2 * double(i % 4)}));
        addTriangle(scene, triangles[i]);
    }
    return scene;
}

class HardCases : public test::GlTest {
protected:
    // Pixels that show something in one picture and nothing in the other, and how many show something at all.
    struct Cover {
        int wrong = 0;
        int shown = 0;
    };
    Cover coverOf(const RenderRequest& colour) {
        RenderRequest request = colour;
        request.output = OutputKind::position;
        const Frame drawn = Renderer().render(request).frame, truth = test::referenceOf(request).frame;
        Cover cover{test::disagreementsOnCover(drawn, truth), 0};
        for (size_t i = 0; i < truth.texels.size(); i += 3) cover.shown += std::isfinite(truth.texels[i]);
        return cover;
    }

    int drawnPixels(RenderRequest request) {
        request.output = OutputKind::position;
        const Frame drawn = Renderer().render(request).frame;
        return static_cast<int>(
                   std::ranges::count_if(drawn.texels, [](float t) { return std::isfinite(t); })) /
               3;
    }

    // `edgePx` is about how long the outlines are on the screen: within the tolerance of them pixels may
    // differ.
    void expectLikeReference(const Scene& scene, double edgePx, glm::dvec3 eye = {}, Camera camera = {}) {
        RenderRequest request = test::requestFor(test::fullCylinderWall(kSizePx, eye), scene, camera);
        request.style = Style::unlit;
        const Cover cover = coverOf(request);
        EXPECT_GT(cover.shown, 0);
        EXPECT_LE(cover.wrong, 2 * request.tolerancePx * edgePx);
        EXPECT_LE(test::differenceFromReference(request).shareOff * kSizePx.x * kSizePx.y,
                  2 * request.tolerancePx * edgePx);
    }
};

TEST_F(HardCases, TriangleAcrossTheSeam) {
    expectLikeReference(coloured({{{{-1, -1, 3}, {1, -1.2f, 3}, {0.2f, 1.5f, 3}}}}), 600);
    expectLikeReference(coloured({{{{-40, -1, 1}, {40, -1, 1}, {0, 30, 2}}}}), 2000);
}

TEST_F(HardCases, TriangleThatContainsTheAxisAboveTheEye) {
    expectLikeReference(coloured({{{{-3, 2, -2}, {3, 2.2f, -2}, {0.3f, 2.5f, 4}}}}), 1600);
    // It fills the top rows all the way round.
    const RenderRequest request = test::requestFor(test::fullCylinderWall(kSizePx),
                                                   coloured({{{{-9, 2, -9}, {9, 2, -9}, {0, 2, 15}}}}));
    const Frame frame = Renderer().render(request).frame;
    for (int x = 0; x < kSizePx.x; ++x) EXPECT_GT(frame.at(x, 0)[0], 0) << "column " << x;
}

TEST_F(HardCases, TriangleThatSurroundsTheEye) {
    expectLikeReference(coloured({{{{-5, -1, -5}, {6, -1.5f, -3}, {0, -0.5f, 7}}}}), 1600);
    expectLikeReference(coloured({{{{-0.01f, -0.01f, -0.01f}, {0.02f, -0.01f, 0}, {0, -0.008f, 0.02f}}}}),
                        1600);
}

TEST_F(HardCases, VertexExactlyAtTheEye) {
    // A triangle with a corner at the eye is seen edge on: it shows nothing, and hides nothing behind it.
    const glm::vec3 eye(0), a(1, 0.5f, -2), b(-1, 0.4f, -2), c(0.2f, -0.9f, -2.5f);
    const std::vector<Triangle> edgeOn{{{eye, a, b}}, {{eye, b, c}}, {{eye, c, a}}};
    RenderRequest alone = test::requestFor(test::fullCylinderWall(kSizePx), coloured(edgeOn));
    EXPECT_LE(drawnPixels(alone), 4);

    std::vector<Triangle> tetrahedron = edgeOn;
    tetrahedron.push_back({a, b, c});
    expectLikeReference(coloured(tetrahedron), 800);
}

TEST_F(HardCases, EdgeThroughTheEye) {
    // The plane of the triangle holds the eye: no pixel centre sees it, near as it comes.
    EXPECT_LE(drawnPixels(test::requestFor(test::fullCylinderWall(kSizePx),
                                           coloured({{{{-1, 0.1f, -3}, {1, -0.1f, 3}, {0.5f, 2, 1}}}}))),
              4);
}

TEST_F(HardCases, SliversOfAspectOneToAHundredThousand) {
    test::Random random(1);
    std::vector<Triangle> slivers;
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 from = random.direction() * random.uniform(1, 5);
        const glm::vec3 along = random.inBox(2);
        const glm::vec3 aside =
            glm::normalize(glm::cross(along, glm::vec3(random.direction()))) * glm::length(along) * 1e-5f;
        slivers.push_back({from, from + along, from + along + aside});
    }
    RenderRequest request = test::requestFor(test::fullCylinderWall(kSizePx), coloured(slivers));
    const Cover cover = coverOf(request);
    // A sliver is 1e-3 px wide: hardly a pixel centre falls into one, by either account.
    EXPECT_LT(cover.wrong, 200);
    EXPECT_LT(cover.shown, 200);
}

TEST_F(HardCases, SliversOfAClosedFanLeaveNoGap) {
    // 100,000 slivers about the eye, two metres high, together a closed band.
    Scene scene;
    startMaterial(scene, plainMaterial({0.8, 0.3, 0.2}));
    constexpr int kCount = 100'000;
    const auto at = [](int i, float y) {
        const double angle = 2 * kPi * (i % kCount) / kCount;
        return glm::vec3(3 * std::sin(angle), y, 3 * std::cos(angle));
    };
    for (int i = 0; i < kCount; ++i) {
        addTriangle(scene, {at(i, -1), at(i + 1, -1), at(i, 1)});
        addTriangle(scene, {at(i + 1, -1), at(i + 1, 1), at(i, 1)});
    }
    RenderRequest request = test::requestFor(test::fullCylinderWall(kSizePx), scene);
    request.output = OutputKind::coverage;
    const Frame coverage = Renderer().render(request).frame;
    for (int y = 270; y < 330; ++y)
        for (int x = 0; x < kSizePx.x; ++x) ASSERT_EQ(*coverage.at(x, y), 1) << x << ", " << y;
}

TEST_F(HardCases, ZeroAreaAndNanTrianglesInAFileLeaveTheRestUntouched) {
    const test::TemporaryFolder folder;
    const std::string path = folder.path("broken.obj");
    std::ofstream(path)
        << "v -1 -1 -3\nv 1 -1 -3\nv 0 1 -3\nv nan 0 -3\nv 2 0 -3\nv 2 0 -3\nv 2 0 -3\nv 0 0 inf\n"
           "f 4 1 2\nf 5 6 7\nf 1 2 3\nf 1 1 2\nf 3 8 1\n";
    const Scene scene = loadScene(path);
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_FALSE(scene.notes.empty());
    expectLikeReference(scene, 600);
}

TEST_F(HardCases, SceneAThousandKilometresAwayRendersLikeOneBesideTheOrigin) {
    Scene scene = loadScene("city:5000");
    const glm::dvec3 farM(700'000, 30'000, -700'000);
    RenderRequest here = test::requestFor(test::fullCylinderWall(kSizePx), scene, {{0, 8, 0}, {0.4, 0, 0}});
    scene.originM += farM;
    const RenderRequest there =
        test::requestFor(test::fullCylinderWall(kSizePx), scene, {farM + glm::dvec3(0, 8, 0), {0.4, 0, 0}});
    // The sum 700,000 + 8 loses 1e-10 m: nothing that a pixel shows.
    EXPECT_LT(compareColor(Renderer().render(here).frame, Renderer().render(there).frame).shareOff, 1e-4);
    EXPECT_LT(test::differenceFromReference(there).shareOff, 0.003);
}

TEST_F(HardCases, RootNodeAThousandKilometresAwayKeepsEveryDetail) {
    // 300 triangles of about 10 cm, 2 m from the eye, as a file whose root node moves them away.
    const test::TemporaryFolder folder;
    test::Random random(3);
    std::string positions;
    for (int i = 0; i < 300; ++i) {
        const glm::dvec3 centre = 2.0 * random.direction();
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 corner = centre + random.inBox(0.1);
            positions.append(reinterpret_cast<const char*>(&corner), sizeof corner);
        }
    }
    folder.write("triangles.bin", positions);
    const auto sceneAt = [&](const std::string& name, const std::string& translation) {
        const std::string bytes = std::to_string(positions.size());
        return loadScene(
            folder.write(name, R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
            "nodes": [{"translation": )" +
                                   translation + R"(, "children": [1]}, {"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "buffers": [{"uri": "triangles.bin", "byteLength": )" +
                                   bytes + R"(}],
            "bufferViews": [{"buffer": 0, "byteLength": )" +
                                   bytes + R"(}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 900, "type": "VEC3",
                           "min": [-3, -3, -3], "max": [3, 3, 3]}]})"));
    };
    const Wall wall = test::fullCylinderWall(kSizePx);
    const RenderRequest here = test::requestFor(wall, sceneAt("here.gltf", "[0, 0, 0]"));
    const RenderRequest there = test::requestFor(wall, sceneAt("there.gltf", "[700000, 30000, -700000]"),
                                                 {{700'000, 30'000, -700'000}, {}});
    EXPECT_LT(compareColor(Renderer().render(here).frame, Renderer().render(there).frame).shareOff, 1e-4);
    EXPECT_LT(test::differenceFromReference(there).shareOff, 0.005);
    EXPECT_GT(coverOf(there).shown, 1000);
}

TEST_F(HardCases, EyeAtNineTenthsOfTheRadius) {
    const glm::dvec3 eye(1.8, 0.2, 0);
    expectLikeReference(coloured({{{{-5, -1, -5}, {6, -1.5f, -3}, {0, -0.5f, 7}}},
                                  {{{2.5f, -1, -1}, {2.5f, -1, 2}, {2.2f, 1, 0}}}}),
                        2400, eye);
    RenderRequest request =
        test::requestFor(test::fullCylinderWall(kSizePx, eye), loadScene("city:5000"), {{0, 8, 0}, {}});
    EXPECT_LT(test::differenceFromReference(request).shareOff, 0.005);
}

TEST_F(HardCases, TrianglesNearerThanTheNearCutAreCutByEveryMethod) {
    // 1e-5 of the two metres to the wall: the first is nearer, the second beyond.
    const auto ahead = [](float z) { return Triangle{{{-z, -z, -z}, {z, -z, -z}, {0, z, -z}}}; };
    for (Method method : {Method::piecewise, Method::imageBased, Method::reference}) {
        RenderRequest cut = test::requestFor(test::fullCylinderWall(kSizePx), coloured({ahead(1e-5f)}));
        cut.method = method;
        EXPECT_EQ(drawnPixels(cut), 0) << static_cast<int>(method);
    }
    expectLikeReference(coloured({ahead(4e-5f)}), 600);
}

TEST_F(HardCases, SmallSingleSidedTrianglesFarAwayTurnTheirRightSide) {
    // A surface of 5 cm triangles, one kilometre away, that faces the eye through a narrow display.
    Scene scene;
    Material material = plainMaterial({0.9, 0.8, 0.2});
    material.doubleSided = false;
    startMaterial(scene, material);
    const glm::mat3 turn(rotationFromOrientation({0.7, 0.5, 0}));
    const auto at = [&](int x, int y) {
        return turn * glm::vec3(0.05f * float(x - 100), 0.05f * float(y - 100), -1000);
    };
    for (int x = 0; x < 200; ++x)
        for (int y = 0; y < 200; ++y)
            addQuad(scene, {at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
    const CylinderWall narrow{2, 0.012, 0.018, {}, {0.7, 0.5, 0}};
    RenderRequest request = test::requestFor(test::cylinderWall(narrow, {}, {800, 600}), std::move(scene));
    request.tolerancePx = 0.002;  // several pieces
    EXPECT_GT(Renderer().render(request).stats.pieces, 1);
    const Cover cover = coverOf(request);
    EXPECT_GT(cover.shown, 100'000);
    EXPECT_LT(cover.wrong, 1000);  // its outline
    EXPECT_LT(test::differenceFromReference(request).shareOff, 0.01);
}

}  // namespace
}  // namespace curvewall
