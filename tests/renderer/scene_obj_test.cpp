#include "calibration/errors.h"
#include "renderer/scene/load_scene.h"
#include "renderer/scene/random.h"
#include "tests/renderer/scene_checks.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace curvewall {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr const char* kSquare =
    "mtllib square.mtl\n"
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
    "usemtl red\n"
    "f 1/1 2/2 3/3 4/4\n";

TEST(Obj, ReadsASquareWithoutItsMaterialFile) {
    const test::TemporaryFolder folder;
    const Scene scene = loadScene(folder.write("square.obj", kSquare));
    test::expectSound(scene);
    EXPECT_EQ(scene.triangles.size(), 2u);
    EXPECT_EQ(scene.name, "square");
    for (const glm::vec3& normal : scene.normals)
        EXPECT_EQ(normal, glm::vec3(0, 0, 1)) << "flat, towards the front";
    EXPECT_EQ(test::cornersAgainstWinding(scene), 0u);
    EXPECT_TRUE(scene.materials[scene.ranges[0].material].doubleSided);
}

TEST(Obj, PutsTheTopOfTheImageAtVZero) {
    const test::TemporaryFolder folder;
    const Scene scene = loadScene(folder.write("square.obj", kSquare));
    for (size_t i = 0; i < scene.positions.size(); ++i) {
        const glm::dvec3 p = scene.originM + glm::dvec3(scene.positions[i]);
        EXPECT_FLOAT_EQ(scene.uvs[i].x, static_cast<float>(p.x));
        EXPECT_FLOAT_EQ(scene.uvs[i].y, 1 - static_cast<float>(p.y));
    }
}

TEST(Obj, ReadsColourAndTexture) {
    const test::TemporaryFolder folder;
    const auto output = OIIO::ImageOutput::create("t.png");
    ASSERT_TRUE(output->open(folder.pathOf("t.png"), OIIO::ImageSpec(2, 2, 3, OIIO::TypeDesc::UINT8)));
    const std::vector<uint8_t> pixels{255, 0, 0, 0, 255, 0, 0, 0, 255, 9, 9, 9};
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) && output->close());
    folder.write("square.mtl", "newmtl red\nKd 0.5 0.25 0.125\nmap_Kd t.png\n");
    const Scene scene = loadScene(folder.write("square.obj", kSquare));
    const Material& material = scene.materials[scene.ranges[0].material];
    EXPECT_EQ(material.name, "red");
    EXPECT_EQ(material.baseColor, glm::vec4(0.5f, 0.25f, 0.125f, 1));
    ASSERT_EQ(material.texture, 0);
    EXPECT_EQ(scene.textures[0].levels[0].texels[0], glm::u8vec4(255, 0, 0, 255))
        << "row 0 is the image's top";
}

TEST(Obj, DissolvesByAlpha) {
    const test::TemporaryFolder folder;
    const auto sceneWith = [&](const std::string& lines) {
        folder.write("square.mtl", "newmtl red\n" + lines);
        return loadScene(folder.write("square.obj", kSquare));
    };
    const auto blendingIn = [](const Scene& scene) {
        const Material& material = scene.materials[scene.ranges[0].material];
        EXPECT_LT(material.alphaCutoff, 0) << "nothing is cut off";
        return material.blending;
    };
    EXPECT_EQ(blendingIn(sceneWith("d 1\n")), Blending::none);
    const Scene half = sceneWith("d 0.5\n");
    EXPECT_EQ(blendingIn(half), Blending::alpha);
    EXPECT_EQ(half.materials[half.ranges[0].material].baseColor.a, 0.5f);
    EXPECT_TRUE(half.notes.empty());
    EXPECT_EQ(blendingIn(sceneWith("map_Kd leaf.png\nmap_d leaf.png\n")), Blending::alpha);
    const Scene other = sceneWith("map_Kd leaf.png\nmap_d mask.png\n");
    EXPECT_EQ(blendingIn(other), Blending::none);
    EXPECT_THAT(other.notes, Contains(HasSubstr("map_d is ignored")));
}

TEST(Obj, NotesAMissingTexture) {
    const test::TemporaryFolder folder;
    folder.write("square.mtl", "newmtl red\nKd 1 0 0\nmap_Kd gone.png\n");
    const Scene scene = loadScene(folder.write("square.obj", kSquare));
    EXPECT_THAT(scene.notes, Contains(HasSubstr("gone.png")));
    EXPECT_EQ(scene.materials[scene.ranges[0].material].texture, -1);
}

TEST(Obj, RefusesAnUnsupportedTexture) {
    const test::TemporaryFolder folder;
    folder.write("square.mtl", "newmtl red\nmap_Kd t.webp\n");
    folder.write("t.webp", std::string("RIFF\0\0\0\0WEBPVP8 ", 16));
    const std::string path = folder.write("square.obj", kSquare);
    EXPECT_THAT(test::messageOf<InputError>([&] { loadScene(path); }), HasSubstr("WebP"));
}

TEST(Obj, DropsTrianglesThatCannotBeDrawn) {
    const test::TemporaryFolder folder;
    const Scene scene = loadScene(folder.write("a.obj",
                                               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv nan 0 0\n"
                                               "f 1 2 3\nf 1 2 4\nf 1 2 5\n"));
    test::expectSound(scene);
    EXPECT_EQ(scene.triangles.size(), 1u);
    EXPECT_EQ(scene.droppedTriangles, 2u);
    EXPECT_THAT(
        scene.notes,
        Contains(HasSubstr("dropped 2 triangles with positions that are not finite or beyond 1e12 m")));
}

TEST(Obj, LeavesOutWhatIsBeyondSinglePrecisionAndKeepsTheRestInPlace) {
    const test::TemporaryFolder folder;
    const Scene scene = loadScene(folder.write(
        "a.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1e30 0 0\nv 2e30 0 0\nv 2e30 1e30 0\nf 1 2 3\nf 4 5 6\nf 1 2 4\n"));
    test::expectSound(scene);
    EXPECT_EQ(scene.droppedTriangles, 2u);
    EXPECT_EQ(scene.originM, glm::dvec3(0.5, 0.5, 0)) << "what is dropped does not move the origin";
    EXPECT_THAT(scene.notes, Contains(HasSubstr("beyond 1e12 m")));
}

TEST(Obj, ReadsPointsAndLines) {
    const test::TemporaryFolder folder;
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    for (const bool hasFace : {false, true}) {
        const Scene scene = loadScene(
            folder.write("a.obj", vertices + (hasFace ? "f 1 2 3 4\n" : "") + "l 1 2 3\np 4\nl 4 1\n"));
        test::expectSound(scene);
        EXPECT_EQ(scene.triangles.size(), hasFace ? 2u : 0u);
        std::vector<glm::dvec3> ends;
        for (const glm::uvec2& line : scene.lines)
            for (const uint32_t end : {line.x, line.y})
                ends.push_back(scene.originM + glm::dvec3(scene.positions[end]));
        const glm::dvec3 a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0);
        EXPECT_THAT(ends, testing::ElementsAre(a, b, b, c, d, a));
        ASSERT_EQ(scene.points.size(), 1u);
        EXPECT_EQ(scene.originM + glm::dvec3(scene.positions[scene.points[0]]), d);
        EXPECT_TRUE(scene.materials[scene.lineRanges[0].material].unlit);
        EXPECT_TRUE(scene.notes.empty());
    }
}

TEST(Obj, RefusesFilesWithNothingToDraw) {
    const test::TemporaryFolder folder;
    for (const char* content :
         {"hello", "v 0 0 0\n", "v 0 0 0\nv 0 0 0\nl 1 2\n", "f 1 2 3\n",
          "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -9\n"}) {
        const std::string path = folder.write("a.obj", content);
        EXPECT_THAT(test::messageOf<InputError>([&] { loadScene(path); }), HasSubstr("a.obj: expected"))
            << content;
    }
}

TEST(Obj, SurvivesDamage) {
    const test::TemporaryFolder folder;
    Random random(5);
    for (int round = 0; round < 300; ++round) {
        std::string content = kSquare;
        for (uint32_t edits = 1 + random.below(6); edits > 0; --edits)
            content[random.below(static_cast<uint32_t>(content.size()))] =
                static_cast<char>(random.below(128));
        try {
            test::expectSound(loadScene(folder.write("a.obj", content)));
        } catch (const InputError&) {
        }
    }
}

}  // namespace
}  // namespace curvewall
