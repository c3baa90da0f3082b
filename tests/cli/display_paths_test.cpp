#include "cli/display_paths.h"

#include "calibration/errors.h"

#include <gtest/gtest.h>

namespace curvewall {
namespace {

TEST(DisplayPaths, OneDisplayKeepsThePathAsItIs) {
    EXPECT_EQ(pathForDisplay("out/a.png", "front", false), "out/a.png");
    EXPECT_EQ(pathForDisplay("", "front", true), "");
}

TEST(DisplayPaths, SeveralDisplaysPutTheirNamesBeforeTheExtension) {
    EXPECT_EQ(pathForDisplay("out/a.b.png", "front", true), "out/a.b-front.png");
    EXPECT_EQ(pathForDisplay("a", "left", true), "a-left");
}

TEST(DisplayPaths, ThePlaceholderIsReplaced) {
    EXPECT_EQ(pathForDisplay("{display}/a.png", "left", true), "left/a.png");
    EXPECT_EQ(pathForDisplay("a-{display}.png", "left", false), "a-left.png");
    EXPECT_EQ(pathForDisplay("{display}/{display}.png", "left", true), "left/left.png");
    EXPECT_EQ(pathForDisplay("{display}.png", "{display}", true), "{display}.png");
}

TEST(DisplayPaths, WithoutANameAllDisplaysAreChosen) {
    const Wall wall{"w", {}, {}, {{"a", {1, 1}, "planar", nullptr}, {"b", {1, 1}, "planar", nullptr}}};
    EXPECT_EQ(chosenDisplays(wall, "").size(), 2u);
    ASSERT_EQ(chosenDisplays(wall, "b").size(), 1u);
    EXPECT_EQ(chosenDisplays(wall, "b")[0]->name, "b");
    EXPECT_THROW(chosenDisplays(wall, "c"), UsageError);
}

}  // namespace
}  // namespace curvewall
