#include "server/library.h"

#include "calibration/errors.h"
#include "renderer/scene/load_scene.h"
#include "tests/server/small_wall.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace curvewall {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr uint64_t kMaxCityTriangles = 1000;

TEST(Library, WallsAreTheJsonObjectsWithAWall) {
    const test::TemporaryFolder folder;
    folder.write("b-wall.json", kSmallWall);
    folder.write("a-wall.json", kSmallWall);
    folder.write("daemon.json", R"({"port": 1})");
    folder.write("schema.json", R"({"properties": {"wall": {}}})");
    folder.write("list.json", R"(["wall"])");
    folder.write("broken.json", R"({"wall": )");
    folder.write("empty.json", R"({"wall": "no displays"})");
    folder.write("notes.txt", kSmallWall);
    folder.write("folder.json/inner.json", kSmallWall);
    const Library library = openLibrary(folder.path(), folder.path("none"), kMaxCityTriangles);
    EXPECT_THAT(wallNames(library), ElementsAre("a-wall", "b-wall"));
    EXPECT_EQ(findWall(library, "a-wall")->name, "small cylinder");
}

TEST(Library, ScenesAreFilesOfTheFolderAndOfItsSubfolders) {
    const test::TemporaryFolder folder;
    for (const char* name : {"one.gltf", "two.glb", "deep/three.obj", "deep/deeper/four.glb", "texture.png",
                             "two.obj", "city.glb"})
        folder.write(name, "");
    const Library library = openLibrary(folder.path(), folder.path(), kMaxCityTriangles);
    EXPECT_THAT(sceneNames(library), ElementsAre("city", "room", "one", "three", "two"));
    EXPECT_THAT(findScene(library, "three"), EndsWith("deep/three.obj"));
    EXPECT_THAT(findScene(library, "two"), EndsWith("two.glb"));
    EXPECT_EQ(findScene(library, "city"), "city");
}

TEST(Library, AFolderOfWallsMustBeThereAndScenesMayBeMissing) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(openLibrary(folder.path("none"), folder.path(), kMaxCityTriangles), InputError);
    const Library library = openLibrary(folder.path(), folder.path("none"), kMaxCityTriangles);
    EXPECT_THAT(wallNames(library), ElementsAre());
    for (const std::string& name : sceneNames(library)) EXPECT_TRUE(isBuiltInScene(name)) << name;
}

TEST(Library, NamesAreNeverPaths) {
    const test::TemporaryFolder folder;
    const std::string wall = folder.write("wall.json", kSmallWall);
    const std::string scene = folder.write("scenes/scene.glb", "");
    const Library library = openLibrary(folder.path(), folder.path("scenes"), kMaxCityTriangles);
    for (const std::string& name : {wall, std::string("wall.json"), std::string("./wall"), std::string(""),
                                    std::string("../") + folder.path("wall")})
        EXPECT_THROW(findWall(library, name), UsageError) << name;
    for (const std::string& name : {scene, std::string("scene.glb"), std::string("scenes/scene"),
                                    std::string(""), std::string("../scenes/scene.glb")})
        EXPECT_THROW(findScene(library, name), UsageError) << name;
}

TEST(Library, ACityIsNoLargerThanAllowed) {
    const test::TemporaryFolder folder;
    const Library library = openLibrary(folder.path(), folder.path(), kMaxCityTriangles);
    EXPECT_EQ(findScene(library, "city:1000"), "city:1000");
    EXPECT_EQ(findScene(library, "city:1000:7"), "city:1000:7");
    for (const char* name : {"city:1001", "city:1001:7", "city:99999999999999999999999", "city:", "city:-1",
                             "city:1e9", "city:1000x", "city::7"})
        EXPECT_THROW(findScene(library, name), UsageError) << name;
}

}  // namespace
}  // namespace curvewall
