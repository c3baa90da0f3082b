#include "calibration/errors.h"
#include "renderer/scene/load_scene.h"
#include "tests/renderer/scene_checks.h"
#include "tests/support/sample_paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace curvewall {
namespace {

using testing::HasSubstr;

TEST(LoadScene, KnowsTheBuiltInNames) {
    for (const char* name : {"room", "city", "city:2000", "city:2000:7"}) {
        EXPECT_TRUE(isBuiltInScene(name)) << name;
        EXPECT_NO_THROW(loadScene(name)) << name;
    }
    for (const char* name : {"", "rooms", "city.obj", "City", "scenes/city"})
        EXPECT_FALSE(isBuiltInScene(name)) << name;
    EXPECT_EQ(loadScene("city:2000:7").triangles.size(), 2000u);
}

TEST(LoadScene, RefusesMalformedBuiltInNames) {
    for (const char* name :
         {"city:", "city:abc", "city:999", "city:5000001", "city:-1", "city:1e4", "city:2000:", "city:2000:x",
          "city:2000:1:1", "city:2000:4294967296", "city: 2000", "room:1"})
        EXPECT_THROW(loadScene(name), UsageError) << name;
    EXPECT_THAT(test::messageOf<UsageError>([] { loadScene("city:999"); }), HasSubstr("1000 to 5000000"));
}

TEST(LoadScene, NamesTheFileItCannotRead) {
    EXPECT_THAT(test::messageOf<InputError>([] { loadScene("missing.glb"); }),
                HasSubstr("missing.glb: expected"));
    const test::TemporaryFolder folder;
    EXPECT_THROW(loadScene(folder.write("scene.stl", "solid")), InputError);
    EXPECT_THROW(loadScene(folder.pathOf("")), InputError);
    for (const char* name : {"empty.gltf", "empty.glb", "empty.obj"})
        EXPECT_THROW(loadScene(folder.write(name, "")), InputError) << name;
}

struct RealScene {
    const char* file;
    size_t triangles;
};

class RealScenes : public testing::TestWithParam<RealScene> {};

TEST_P(RealScenes, HaveAllTheirTriangles) {
    const std::filesystem::path path = test::scenesFolder() / GetParam().file;
    if (!std::filesystem::exists(path))
        GTEST_SKIP() << path << " is not here; set CURVEWALL_SAMPLES to the samples folder";
    const Scene scene = loadScene(path.string());
    test::expectSound(scene);
    EXPECT_EQ(scene.triangles.size() + scene.droppedTriangles, GetParam().triangles);
    EXPECT_FALSE(scene.textures.empty());
}

INSTANTIATE_TEST_SUITE_P(Files, RealScenes,
                         testing::Values(RealScene{"kenney_city/kenney_city.glb", 370'916},
                                         RealScene{"dutch_ship/dutch_ship_medium_1k.gltf", 69'162},
                                         RealScene{"vr_gallery/vr_gallery.glb", 1'930}));

}  // namespace
}  // namespace curvewall
