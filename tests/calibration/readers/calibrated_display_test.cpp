// Displays of a wall file that are calibrations of other programs.

#include "calibration/errors.h"
#include "calibration/files/map_file.h"
#include "calibration/readers/wall_reader.h"
#include "tests/support/temporary_folder.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace curvewall {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

// A fisheye over the whole screen; half as bright on the right.
constexpr const char* kBourke = "2\n2 2\n-2 -1 0 0 1\n2 -1 1 0 0.5\n-2 1 0 1 1\n2 1 1 1 0.5\n";

// Two flat pictures to the left and to the right.
constexpr const char* kMpcdi = R"(<MPCDI profile="3d" version="1.0"><display><buffer id="b">
    <region id="left" x="0" y="0" xsize="0.5" ysize="1" Xresolution="40" Yresolution="30"><frustum>
        <yaw>-30</yaw><pitch>0</pitch><roll>0</roll>
        <rightAngle>20</rightAngle><leftAngle>-20</leftAngle><upAngle>15</upAngle><downAngle>-15</downAngle></frustum></region>
    <region id="right" x="0.5" y="0" xsize="0.5" ysize="1" Xresolution="40" Yresolution="30"><frustum>
        <yaw>30</yaw><pitch>0</pitch><roll>0</roll>
        <rightAngle>20</rightAngle><leftAngle>-20</leftAngle><upAngle>15</upAngle><downAngle>-15</downAngle></frustum></region>
    </buffer></display></MPCDI>)";

class CalibratedDisplay : public testing::Test {
protected:
    void SetUp() override {
        folder_.write("mesh.data", kBourke);
        folder_.write("two.xml", kMpcdi);
    }

    Wall read(const json& display) const {
        return readWall(folder_.write("wall.json", json{{"wall", "w"}, {"displays", {display}}}.dump()));
    }

    std::string complaintAbout(const json& display) const {
        try {
            read(display);
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }

    static json mesh(const json& assume = json::object()) {
        return {{"name", "dome"},
                {"size", {64, 32}},
                {"calibration", {{"file", "mesh.data"}, {"assume", assume}}}};
    }

    test::TemporaryFolder folder_;
};

double degreesOffZenith(const Wall& wall, glm::dvec2 px) {
    const glm::dvec3 ray = glm::normalize(*wall.displays[0].projection->unproject(px));
    return glm::degrees(std::acos(ray.y));
}

TEST_F(CalibratedDisplay, TakesWhatTheReaderAssumes) {
    const Wall wall = read(mesh());
    ASSERT_EQ(wall.displays.size(), 1U);
    EXPECT_EQ(wall.displays[0].name, "dome");
    EXPECT_EQ(wall.displays[0].sizePx, glm::ivec2(64, 32));
    EXPECT_NEAR(degreesOffZenith(wall, {32, 16}), 0, 1e-6);
    EXPECT_NEAR(degreesOffZenith(wall, {32, 8}), 45, 1e-6);  // half the radius of 90 degrees
    EXPECT_FALSE(wall.displays[0].assumptions.empty());
    ASSERT_TRUE(wall.displays[0].blend);
}

TEST_F(CalibratedDisplay, EveryAssumptionCanBeOverruled) {
    const Wall wall = read(mesh({{"source_fov_deg", 120}, {"intensity_gamma", 1}}));
    EXPECT_NEAR(degreesOffZenith(wall, {32, 8}), 30, 1e-6);
    EXPECT_NEAR(wall.displays[0].blend->alpha[63].x, 0.5 + 0.5 * 0.5 / 64, 1e-6);
    int given = 0;
    for (const Assumption& assumption : wall.displays[0].assumptions) given += assumption.isGiven;
    EXPECT_EQ(given, 2);
}

TEST_F(CalibratedDisplay, ASourceTakesThePlaceOfTheAssumedOne) {
    json display = mesh();
    display["calibration"]["source"] = {
        {"size", {100, 100}},
        {"projection",
         {{"type", "frustum"}, {"left_deg", -45}, {"right_deg", 45}, {"down_deg", -45}, {"up_deg", 45}}}};
    const glm::dvec3 ray = *read(display).displays[0].projection->unproject({64, 16});
    EXPECT_NEAR(ray.x / -ray.z, 1, 1e-9);
    EXPECT_NEAR(ray.y, 0, 1e-9);
}

TEST_F(CalibratedDisplay, AFileMayHoldSeveralWithNamesOfItsOwn) {
    const Wall both = read({{"calibration", {{"file", "two.xml"}}}});
    ASSERT_EQ(both.displays.size(), 2U);
    EXPECT_EQ(both.displays[0].name, "left");
    EXPECT_EQ(both.displays[1].name, "right");
    EXPECT_EQ(both.displays[1].sizePx, glm::ivec2(40, 30));
    const Wall right = read({{"name", "east"}, {"calibration", {{"file", "two.xml"}, {"display", "right"}}}});
    ASSERT_EQ(right.displays.size(), 1U);
    EXPECT_EQ(right.displays[0].name, "east");
    EXPECT_GT(right.displays[0].projection->unproject({20, 15})->x, 0);
}

TEST_F(CalibratedDisplay, ABlendOfTheWallFileTakesThePlaceOfTheFiles) {
    NumberMap alpha{{64, 32}, 1, false, std::vector<float>(64 * 32, 1.0f)};
    writePng16(folder_.path("alpha.png"), alpha);
    json display = mesh();
    display["blend"] = {{"alpha", "alpha.png"}};
    EXPECT_EQ(read(display).displays[0].blend->alpha[63].x, 1.0f);
}

TEST_F(CalibratedDisplay, MistakesNameTheFieldAndWhatThereIs) {
    EXPECT_THAT(complaintAbout(mesh({{"row_odour", 1}})),
                AllOf(HasSubstr("displays[0].calibration.assume"), HasSubstr("source_fov_deg"),
                      HasSubstr("\"row_odour\"")));
    EXPECT_THAT(complaintAbout(mesh({{"source", "sphere"}})),
                AllOf(HasSubstr("assume.source"), HasSubstr("fisheye")));
    EXPECT_THAT(complaintAbout({{"name", "both"}, {"calibration", {{"file", "two.xml"}}}}),
                AllOf(HasSubstr("calibration.display"), HasSubstr("left, right")));
    EXPECT_THAT(complaintAbout({{"calibration", {{"file", "two.xml"}, {"display", "middle"}}}}),
                HasSubstr("middle"));
    EXPECT_THAT(complaintAbout({{"calibration", {{"file", "none.sgc"}}}}), HasSubstr("calibration.file"));
    EXPECT_THAT(complaintAbout({{"calibration", {{"file", "wall.json"}}}}), HasSubstr("wall.json"));
    json both = mesh();
    both["projection"] = {{"type", "frustum"}};
    EXPECT_THAT(complaintAbout(both), HasSubstr("a projection or a calibration"));
}

TEST_F(CalibratedDisplay, ABareFileIsAWallOfItself) {
    const Wall wall = readWall(folder_.path("mesh.data"));
    EXPECT_EQ(wall.name, "mesh");
    EXPECT_EQ(wall.displays[0].sizePx, glm::ivec2(1920, 960));
    EXPECT_EQ(readWall(folder_.path("mesh.data"), glm::ivec2(200, 100)).displays[0].sizePx,
              glm::ivec2(200, 100));
    EXPECT_THAT(readWall(folder_.path("mesh.data"), glm::ivec2(200, 200)).displays[0].warnings,
                testing::Contains(HasSubstr("200 x 200")));
    EXPECT_THROW(readWall(CURVEWALL_SOURCE_DIR "/configs/planar-90.json", glm::ivec2(8, 8)), UsageError);
    EXPECT_THROW(readWall(folder_.write("any.bin", "neither this nor that")), InputError);
}

}  // namespace
}  // namespace curvewall
