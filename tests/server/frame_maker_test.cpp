#include "server/frame_maker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace curvewall {
namespace {

using ::testing::ElementsAre;

TEST(SceneCache, KeepsTheScenesThatWereUsedLast) {
    std::vector<std::string> loaded;
    SceneCache cache(2, [&loaded](const std::string& name) {
        loaded.push_back(name);
        Scene scene;
        scene.name = name;
        return scene;
    });
    for (const char* name : {"a", "b", "a", "c", "a", "b"}) EXPECT_EQ(cache.get(name)->name, name);
    EXPECT_THAT(loaded, ElementsAre("a", "b", "c", "b"));
}

TEST(SceneCache, ASceneThatDoesNotLoadIsTriedAgain) {
    int attempts = 0;
    SceneCache cache(1, [&attempts](const std::string&) -> Scene {
        if (++attempts == 1) throw std::runtime_error("broken");
        return {};
    });
    EXPECT_THROW(cache.get("a"), std::runtime_error);
    EXPECT_NO_THROW(cache.get("a"));
    EXPECT_EQ(attempts, 2);
}

}  // namespace
}  // namespace curvewall
