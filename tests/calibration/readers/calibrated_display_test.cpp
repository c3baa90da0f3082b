// Displays of a wall file that are calibrations of other programs.

#include "calibration/errors.h"
#include "calibration/files/map_file.h"
#include "calibration/readers/wall_reader.h"
#include "tests/support/random_numbers.h"
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

TEST_F(CalibratedDisplay, ACalibrationTellsTheWallItsEyeUnlessTheWallFileDoes) {
    folder_.write("config.json", R"({"version": 1, "masteraddress": "localhost",
        "users": [{"eyeseparation": 0.06, "pos": {"x": 0, "y": 0, "z": 1.5}}],
        "nodes": [{"address": "localhost", "port": 20400, "windows": [{"size": {"x": 64, "y": 48}, "viewports": [
            {"projection": {"type": "ProjectionPlane", "lowerleft": {"x": -1, "y": -1, "z": -1},
             "upperleft": {"x": -1, "y": 1, "z": -1}, "upperright": {"x": 1, "y": 1, "z": -1}}}]}]}]})");
    const json flat{{"name", "flat"},
                    {"size", {64, 48}},
                    {"projection",
                     {{"type", "planar"},
                      {"lower_left", {-1, -1, -1}},
                      {"lower_right", {1, -1, -1}},
                      {"upper_left", {-1, 1, -1}}}}};
    const json calibrated{{"name", "calibrated"}, {"calibration", {{"file", "config.json"}}}};
    json wall{{"wall", "w"}, {"displays", {flat, calibrated}}};
    const auto rightBorder = [&](const Wall& read, size_t display) {
        const glm::dvec3 ray = *read.displays[display].projection->unproject({64, 24});
        return ray.x / -ray.z;
    };
    const Wall fromFile = readWall(folder_.write("wall.json", wall.dump()));
    EXPECT_EQ(fromFile.eyeM, glm::dvec3(0, 0, 1.5));
    EXPECT_EQ(fromFile.displays[0].name, "flat");
    EXPECT_NEAR(rightBorder(fromFile, 0), 1 / 2.5, 1e-9);
    EXPECT_NEAR(rightBorder(fromFile, 1), 1 / 2.5, 1e-9);
    wall["eye"] = {0, 0, 0};
    const Wall fromWall = readWall(folder_.write("wall.json", wall.dump()));
    EXPECT_EQ(fromWall.eyeM, glm::dvec3(0));
    EXPECT_NEAR(rightBorder(fromWall, 0), 1, 1e-9);
    EXPECT_NEAR(rightBorder(fromWall, 1), 1, 1e-9);
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

// Where every cell lies over every other one each pixel would have to look at all of them.
TEST_F(CalibratedDisplay, AMeshWithoutOrderIsRefused) {
    test::Random random(11);
    std::string text = "2\n20 20\n";
    for (int i = 0; i < 400; ++i)
        text += std::to_string(random.uniform(-1.7, 1.7)) + " " + std::to_string(random.uniform(-1, 1)) +
                " " + std::to_string(random.uniform(0, 1)) + " " + std::to_string(random.uniform(0, 1)) +
                " 0.5\n";
    folder_.write("mesh.data", text);
    EXPECT_THAT(complaintAbout(mesh()), HasSubstr("times"));
}

TEST_F(CalibratedDisplay, FactorsOfGigabytesAreRefused) {
    json display = mesh();
    display["size"] = {16384, 8192};
    EXPECT_THAT(complaintAbout(display), HasSubstr("intensities"));
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
