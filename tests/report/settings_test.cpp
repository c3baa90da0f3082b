#include "report/settings.h"

#include "tests/support/rendering.h"
#include "tests/support/small_walls.h"
#include "tests/support/test_scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

namespace curvewall {
namespace {

using ::testing::Contains;

RenderRequest base() {
    RenderRequest request =
        test::requestFor(test::smallShippedWall("dome-master", 32), boxRoom({8, 5, 8}), {});
    request.tolerancePx = 0.3;
    return request;
}

std::set<std::string> textsOf(Extent extent) {
    std::set<std::string> texts;
    for (const Setting& setting : settingsFor(base(), extent)) texts.insert(setting.name.text());
    return texts;
}

TEST(Settings, EachHasATextOfItsOwn) {
    for (const double tolerancePx : {0.3, 0.25, 1.0})
        for (const Extent extent : {Extent::quick, Extent::full}) {
            RenderRequest request = base();
            request.tolerancePx = tolerancePx;
            std::set<std::string> texts;
            for (const Setting& setting : settingsFor(request, extent))
                EXPECT_TRUE(texts.insert(setting.name.text()).second) << setting.name.text();
        }
}

TEST(Settings, FacesHaveSizesThatCanBeAskedFor) {
    for (const char* wall : {"dome-master", "full-cylinder"})
        for (const int divisor : {1, 32, 256}) {
            RenderRequest request = base();
            request.wall = std::make_shared<const Wall>(test::smallShippedWall(wall, divisor));
            for (const Setting& setting : settingsFor(request, Extent::full))
                if (setting.name.knob == "face_size_px") {
                    EXPECT_GE(setting.name.value, kLeastFacePx);
                    EXPECT_LE(setting.name.value, kMostAutomaticFacePx);
                }
        }
}

TEST(Settings, TurnEveryKnobOfEveryMethod) {
    std::set<std::string> methods;
    std::set<std::string> knobs;
    for (const Setting& setting : settingsFor(base(), Extent::full)) {
        methods.insert(setting.name.method);
        knobs.insert(setting.name.knob);
    }
    EXPECT_THAT(methods, ::testing::ElementsAre("bounded-raycast", "image-based", "piecewise", "reference",
                                                "vertex-warp"));
    EXPECT_THAT(knobs,
                ::testing::ElementsAre("", "face_size_px", "samples", "tessellation_px", "tolerance_px"));
}

TEST(Settings, HaveTheToleranceThatIsAskedFor) {
    for (const Extent extent : {Extent::quick, Extent::full})
        EXPECT_THAT(textsOf(extent), Contains("piecewise, 0.3 px"));
}

TEST(Settings, QuickOnesAreAmongAll) { EXPECT_THAT(textsOf(Extent::quick), Contains("vertex-warp, 16 px")); }

TEST(Settings, ShowOnePictureACurve) {
    std::set<std::string> curves;
    for (const Setting& setting : settingsFor(base(), Extent::full))
        if (setting.isShown) {
            EXPECT_TRUE(curves.insert(setting.name.curve()).second) << setting.name.text();
        }
    EXPECT_GE(curves.size(), 5u);
}

TEST(Settings, DoWhatTheirNamesSay) {
    for (const Setting& setting : settingsFor(base(), Extent::full)) {
        const RenderRequest& request = setting.request;
        const std::map<std::string, double> turned{{"", setting.name.value},
                                                   {"tolerance_px", request.tolerancePx},
                                                   {"face_size_px", request.faceSizePx},
                                                   {"tessellation_px", request.tessellationPx},
                                                   {"samples", request.samples}};
        EXPECT_EQ(turned.at(setting.name.knob), setting.name.value) << setting.name.text();
        EXPECT_EQ(setting.request.samples, setting.name.samples);
    }
}

}  // namespace
}  // namespace curvewall
