#include "report/curve_style.h"

#include "renderer/scene/room.h"
#include "report/settings.h"
#include "tests/support/rendering.h"
#include "tests/support/shipped_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace curvewall {
namespace {

std::vector<std::string> curvesOfAllSettings() {
    std::vector<std::string> names;
    const RenderRequest request = test::requestFor(test::shippedWall("dome-master"), makeRoom());
    for (const Setting& setting : settingsFor(request, Extent::full))
        if (std::ranges::find(names, setting.name.curve()) == names.end())
            names.push_back(setting.name.curve());
    return names;
}

TEST(CurveStyles, OfAllThatIsMeasuredDiffer) {
    const std::vector<std::string> names = curvesOfAllSettings();
    const std::vector<CurveStyle> styles = curveStyles(names);
    ASSERT_EQ(styles.size(), names.size());
    for (size_t i = 0; i < names.size(); ++i)
        for (size_t j = 0; j < i; ++j) EXPECT_FALSE(styles[i] == styles[j]) << names[i] << ", " << names[j];
}

TEST(CurveStyles, OfAMethodsMainCurveAreTheSameInAnyCompany) {
    for (const char* name : {"piecewise", "image-based, cube, bicubic", "vertex-warp", "reference"}) {
        const CurveStyle alone = curveStyles({name})[0];
        EXPECT_EQ(curveStyles({"mine", "bounded-raycast, triangle", name})[2], alone) << name;
    }
}

TEST(CurveStyles, ThereIsOneForEveryNameHoweverMany) {
    const std::vector<std::string> names(100, "mine");
    EXPECT_EQ(curveStyles(names).size(), 100u);
}

}  // namespace
}  // namespace curvewall
