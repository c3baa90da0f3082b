// The program as a shell sees it: exit codes, messages, files.

#include "calibration/files/map_file.h"
#include "renderer/image_file.h"
#include "tests/cli/program_run.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

namespace curvewall {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

using test::Outcome;

Outcome run(const std::string& environment, const std::string& arguments) {
    return test::runProgram(arguments, environment);
}

json readJson(const std::string& path) {
    std::ifstream file(path);
    return json::parse(file);
}

class Program : public test::GlTest {
protected:
    void SetUp() override {
        test::GlTest::SetUp();
        std::ofstream(wall()) << R"({"wall": "small", "displays": [
            {"name": "left", "size": [160, 120],
             "projection": {"type": "cylinder", "radius": 2, "arc_deg": 360, "height": 9.4247779608}},
            {"name": "right", "size": [64, 48],
             "projection": {"type": "planar", "lower_left": [-1, -1, -1], "lower_right": [1, -1, -1],
                            "upper_left": [-1, 1, -1]}}]})";
    }
    std::string wall() const { return folder_.path("wall.json"); }
    std::string file(const std::string& name) const { return folder_.path(name); }

    test::TemporaryFolder folder_;
};

TEST_F(Program, RendersEveryDisplayIntoAFileOfItsOwn) {
    const Outcome outcome = run("", "render " + wall() + " --scene city:5000 --out " + file("a.png") +
                                        " --stats " + file("{display}.json"));
    ASSERT_EQ(outcome.exitCode, 0) << outcome.output;
    EXPECT_EQ(readFrame(file("a-left.png")).sizePx, glm::ivec2(160, 120));
    EXPECT_EQ(readFrame(file("a-right.png")).sizePx, glm::ivec2(64, 48));
    const json stats = readJson(file("left.json"));
    for (const char* key :
         {"method", "engine", "tolerance_px", "geometric_error_px", "pieces", "triangles", "pairs",
          "replication_ratio", "samples", "frame_ms", "gl_renderer", "peak_memory_mib"})
        EXPECT_TRUE(stats.contains(key)) << key;
    EXPECT_EQ(stats["triangles"], 5000);
    EXPECT_LE(stats["geometric_error_px"]["max"], 0.25);
    EXPECT_EQ(readJson(file("right.json"))["pieces"], 1);
}

TEST_F(Program, EveryMethodAndOutputWritesWhatItSays) {
    for (const char* method : {"piecewise", "image-based", "reference"}) {
        for (const auto& [kind, channels] :
             {std::pair{"depth", 1}, {"coverage", 1}, {"position", 3}, {"color", 3}}) {
            const std::string out = file(std::string(method) + kind + ".exr");
            const Outcome outcome =
                run("", "render " + wall() + " --display left --scene room --method " + method +
                            " --output-kind " + kind + " --frames 2 --out " + out);
            ASSERT_EQ(outcome.exitCode, 0) << outcome.output;
            EXPECT_EQ(readFrame(out).channels, channels);
        }
    }
}

TEST_F(Program, InspectReportsTheCertificateAsJson) {
    const Outcome outcome =
        run("", "inspect " + wall() + " --display left --tolerance 0.5 --json --pieces " + file("p.json") +
                    " --rays " + file("r.exr") + " --error-map " + file("e.exr"));
    ASSERT_EQ(outcome.exitCode, 0) << outcome.output;
    const json display = json::parse(outcome.output)["displays"][0];
    EXPECT_EQ(display["size"], json({160, 120}));
    EXPECT_LE(display["geometric_error_px"]["max"], 0.5);
    EXPECT_EQ(display["uncovered_pixels"], 0);
    EXPECT_EQ(readJson(file("p.json"))["pieces"].size(), display["pieces"]);
    // The files say the same as the report.
    const Frame errors = readFrame(file("e.exr"));
    EXPECT_EQ(*std::ranges::max_element(errors.texels), display["geometric_error_px"]["max"].get<float>());
    const Frame rays = readFrame(file("r.exr"));
    const float* ahead = rays.at(80, 60);
    EXPECT_NEAR(ahead[2], -1, 1e-3);
}

TEST_F(Program, InspectListsWhatWasAssumedOfACalibration) {
    const std::string mesh =
        folder_.write("mesh.data", "2\n2 2\n-2 -1 0 0 1\n2 -1 1 0 1\n-2 1 0 1 1\n2 1 1 1 1\n");
    const Outcome text = run("", "inspect --read-only --size 60x60 " + mesh);
    ASSERT_EQ(text.exitCode, 0) << text.output;
    EXPECT_THAT(text.output, HasSubstr("assumed source fisheye"));
    EXPECT_THAT(text.output, HasSubstr("warning: size: 60 x 60"));
    const Outcome asJson = run("", "inspect --read-only --json --size 60x30 " + mesh);
    const json display = json::parse(asJson.output)["displays"][0];
    EXPECT_EQ(display["size"], json({60, 30}));
    EXPECT_TRUE(display["warnings"].empty());
    EXPECT_FALSE(display.contains("pieces"));
    bool listed = false;
    for (const json& a : display["assumptions"])
        listed = listed || (a["key"] == "source_fov_deg" && a["value"] == "180" && !a["evidence"].empty() &&
                            a["given"] == false);
    EXPECT_TRUE(listed) << display["assumptions"].dump(1);
    const Outcome rendered =
        run("", "render --size 60x30 " + mesh + " --scene room --out " + file("mesh.png"));
    EXPECT_EQ(rendered.exitCode, 0) << rendered.output;
    EXPECT_EQ(readFrame(file("mesh.png")).sizePx, glm::ivec2(60, 30));
    for (const char* size : {"60", "60x", "x30", "0x30", "60x99999", "60x30x2"})
        EXPECT_EQ(run("", "inspect --size " + std::string(size) + " " + mesh).exitCode, 2) << size;
    EXPECT_EQ(run("", "inspect --size 60x30 " + wall()).exitCode, 2);
    EXPECT_EQ(run("", "inspect --read-only --lower-bound " + mesh).exitCode, 2);
}

TEST_F(Program, InspectLetsThePiecesFollowTheEye) {
    const Outcome outcome = run("", "inspect " + wall() + " --tolerance 0.5 --eye 0.01,0,0 --refit --json");
    ASSERT_EQ(outcome.exitCode, 0) << outcome.output;
    for (const json& display : json::parse(outcome.output)["displays"]) {
        const json& refit = display["refit"];
        EXPECT_EQ(refit["certificate"]["every"], 8);
        EXPECT_LE(refit["certificate"]["max"], 0.5);
        EXPECT_LE(display["geometric_error_px"]["max"], 0.5);
        EXPECT_GE(display["geometric_error_px"]["max"], refit["certificate"]["max"]);
        EXPECT_EQ(refit["own_eye"]["pieces"], display["pieces"]);
    }
    const Outcome text = run("", "inspect " + wall() + " --eye 0.01,0,0 --refit");
    EXPECT_THAT(text.output, HasSubstr("every 8th row and column"));
}

TEST_F(Program, InspectSaysHowFarTheMeshIsFromTheLowerBound) {
    const std::string command = "inspect " + wall() + " --display left --tolerance 0.5 --lower-bound";
    const Outcome asJson = run("", command + " --json");
    ASSERT_EQ(asJson.exitCode, 0) << asJson.output;
    const json display = json::parse(asJson.output)["displays"][0];
    const double pieces = display["pieces"], bound = display["lower_bound_pieces"];
    EXPECT_GE(bound, 1);
    EXPECT_LE(bound, pieces);
    EXPECT_NEAR(display["pieces_over_lower_bound"].get<double>(), pieces / bound, 1e-9);
    const Outcome text = run("", command);
    EXPECT_EQ(text.exitCode, 0);
    EXPECT_NE(text.output.find("lower bound of the number of pieces"), std::string::npos) << text.output;
}

TEST_F(Program, MasksOfAWallAreWrittenAndUsedAsInspectSays) {
    // Two flat screens that turn away from each other and share a third of what they show.
    const auto wallText = [](const json& left, const json& right) {
        json wall = json::parse(R"({"wall": "pair", "displays": []})");
        for (const auto& [name, yawDeg, blend] : {std::tuple{"left", -25, left}, {"right", 25, right}})
            wall["displays"].push_back({{"name", name},
                                        {"size", {160, 120}},
                                        {"blend", blend},
                                        {"projection",
                                         {{"type", "planar"},
                                          {"lower_left", {-1, -0.75, -1}},
                                          {"lower_right", {1, -0.75, -1}},
                                          {"upper_left", {-1, 0.75, -1}},
                                          {"yaw_deg", yawDeg}}}});
        return wall.dump();
    };
    const std::string plain = folder_.write("pair.json", wallText(json::object(), json::object()));
    const std::string folder = file("made/here");
    const Outcome text = run("", "inspect " + plain + " --blend " + folder);
    ASSERT_EQ(text.exitCode, 0) << text.output;
    EXPECT_THAT(text.output, HasSubstr(R"("blend": {"alpha":"made/here/left-alpha.png"})"));
    EXPECT_THAT(text.output, HasSubstr("sum to 1 within"));

    const Outcome asJson = run("", "inspect " + plain + " --json --blend " + folder);
    ASSERT_EQ(asJson.exitCode, 0) << asJson.output;
    const json blend = json::parse(asJson.output)["blend"];
    ASSERT_EQ(blend["displays"].size(), 2u);
    EXPECT_NEAR(blend["displays"][0]["overlap_share"], 0.5, 0.2);
    EXPECT_LT(blend["sum_deviation"]["share_above_1_percent"], 0.01);
    EXPECT_GE(blend["sum_deviation"]["max"], 0);
    EXPECT_TRUE(blend["sum_deviation"]["max_at"].contains("pixel"));

    // A white wall with the masks shows the masks.
    const json lines[] = {blend["displays"][0]["blend"], blend["displays"][1]["blend"]};
    json masked = json::parse(wallText(lines[0], lines[1]));
    masked["background"] = {1, 1, 1};
    folder_.write("empty.obj", "v 0 9 9\nv 1 9 9\nv 0 9 8\nf 1 2 3\n");
    const std::string rendered = "render " + folder_.write("masked.json", masked.dump()) + " --scene " +
                                 file("empty.obj") + " --camera 0,0,0 --out " + file("m.exr");
    const Outcome outcome = run("", rendered);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.output;
    for (const char* name : {"left", "right"}) {
        const NumberMap mask = readNumberMap(folder + "/" + name + "-alpha.png");
        const Frame frame = readFrame(file("m-" + std::string(name) + ".exr"));
        ASSERT_EQ(mask.sizePx, frame.sizePx);
        for (size_t i = 0; i < mask.values.size(); ++i)
            ASSERT_NEAR(frame.texels[3 * i], mask.values[i], 1e-6) << name << " " << i;
    }
}

TEST_F(Program, AnotherEyeIsAnOptionOfRenderAndInspect) {
    const auto picture = [&](const std::string& options, const std::string& name) {
        const Outcome outcome =
            run("", "render " + wall() + " --scene room --display left --out " + file(name) + options);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.output;
        return readFrame(file(name)).texels;
    };
    const std::vector<float> own = picture("", "own.png");
    EXPECT_EQ(own, picture(" --eye 0,0,0", "same.png"));
    EXPECT_NE(own, picture(" --eye 0.5,0.2,-0.4", "moved.png"));
    const auto firstRay = [&](const std::string& options) {
        EXPECT_EQ(
            run("", "inspect " + wall() + " --display right --rays " + file("r.exr") + options).exitCode, 0);
        return readFrame(file("r.exr")).at(0, 0)[0];
    };
    // The screen is one metre ahead and reaches one metre to the left.
    const double x = -1 + 1.0 / 64, y = 1 - 1.0 / 48;
    EXPECT_NEAR(firstRay(""), x / std::sqrt(x * x + y * y + 1), 1e-6);
    EXPECT_NEAR(firstRay(" --eye 0.5,0,1"), (x - 0.5) / std::sqrt((x - 0.5) * (x - 0.5) + y * y + 4), 1e-6);
}

TEST_F(Program, ConvertWritesEveryFormatAndSaysWhatItCosts) {
    struct Case {
        std::string out, options, wallFile;
        std::vector<std::string> files;
        double mostPx;
    };
    for (const Case& c : std::vector<Case>{
             {"map.exr", "", "map.json", {"map-left.exr", "map-right.exr"}, 0.01},
             {"{display}-points.pfm", "", "wall-points.json", {"left-points.pfm", "right-points.pfm"}, 0.01},
             {"flat.exr", "--as camera-texture --display right", "flat.json", {"flat.exr"}, 0.01},
             {"mesh.data", "", "mesh.json", {"mesh-left.data", "mesh-right.data"}, 0.3},
             {"mesh.txt", "--as bourke --grid 9x7", "mesh.json", {"mesh-left.txt", "mesh-right.txt"}, 40},
             {"all.mpcdi", "", "", {"all.mpcdi"}, 0.01},
         }) {
        SCOPED_TRACE(c.out);
        const Outcome outcome = run("", "convert --json " + wall() + " '" + file(c.out) + "' " + c.options);
        ASSERT_EQ(outcome.exitCode, 0) << outcome.output;
        const json report = json::parse(outcome.output);
        for (const json& display : report["displays"]) {
            EXPECT_LT(display["conversion_error_px"]["max"], c.mostPx);
            EXPECT_LE(display["conversion_error_px"]["mean"], display["conversion_error_px"]["max"]);
            EXPECT_EQ(display["holes_gained"], 0);
            EXPECT_EQ(display["blend_difference"], 0);
        }
        for (const std::string& name : c.files) EXPECT_TRUE(std::ifstream(file(name)).good()) << name;
        EXPECT_EQ(report.value("wall_file", ""), c.wallFile.empty() ? "" : file(c.wallFile));
        const Outcome read = run("", "inspect --read-only " + file(c.wallFile.empty() ? c.out : c.wallFile));
        EXPECT_EQ(read.exitCode, 0) << read.output;
    }
    EXPECT_THAT(run("", "convert " + wall() + " " + file("map.exr")).output,
                HasSubstr("error of the conversion over every pixel: "));
}

TEST_F(Program, ExitCodesTellWhoHasToDoSomething) {
    EXPECT_EQ(run("", "--help").exitCode, 0);
    EXPECT_EQ(run("", "--version").exitCode, 0);
    struct Case {
        std::string arguments;
        int exitCode;
        std::string says;
    };
    const std::string render = "render " + wall() + " --scene room ";
    for (const Case& c : std::vector<Case>{
             {"", 2, "subcommand"},
             {"rendr", 2, "rendr"},
             {render + "--tolerence 1", 2, "--tolerence"},
             {render + "--tolerance 0", 2, "--tolerance"},
             {render + "--tolerance nan", 2, "--tolerance"},
             {render + "--face-size 15", 2, "--face-size"},
             {render + "--method magic", 2,
              "piecewise, image-based, bounded-raycast, vertex-warp, reference or auto"},
             {render + "--source sphere", 2, "cube, hemicube or planar"},
             {render + "--filter cubic", 2, "nearest, linear, bicubic, mipmap or anisotropic"},
             {render + "--faces six", 2, "separate or layered"},
             {render + "--lookup table", 2, "pixel or mesh"},
             {render + "--mesh-step 3", 2, "4"},
             {render + "--method image-based --source planar", 2, "the cube source holds it"},
             {render + "--style cubist", 2, "textured, unlit, wireframe or pen-and-ink"},
             {render + "--engine steam", 2, "compute, geometry, tessellation or loop"},
             {render + "--display middle", 2, "left, right"},
             {render + "--camera 1,2", 2, "x,y,z"},
             {render + "--out a.gif", 2, ".gif"},
             {render + "--eye 1,2", 2, "--eye"},
             {render + "--eye 0,0,2", 2, "display \"left\": the eye is not inside the cylinder"},
             {render + "--eye 0,0,-1", 2, "display \"right\": the eye lies in the plane"},
             {"inspect " + wall() + " --eye 0,0,2", 2, "the eye is not inside the cylinder"},
             {"inspect " + wall() + " --refit", 2, "--refit needs --eye"},
             {"inspect " + wall() + " --display left --blend " + file("b"), 2, "leave out --display"},
             {"inspect " + wall() + " --blend " + wall(), 1, "cannot be made a folder"},
             {render + "--output-kind depth --out a.png", 2, ".exr"},
             {"render " + wall() + " --scene city:999", 2, "1000"},
             {"render " + file("none.json") + " --scene room", 3, "none.json"},
             {"render " + wall() + " --scene " + file("none.glb"), 3, "none.glb"},
             {"render " + wall() + " --scene " + wall(), 3, "wall.json"},
             {render + "--out " + file("no/such/folder.png"), 1, "there is no folder"},
             {"serve " + file("none.json"), 3, "none.json"},
             {"convert " + wall(), 2, "OUT"},
             {"convert " + wall() + " " + file("a.gif"), 2, ".mpcdi"},
             {"convert " + wall() + " " + file("a.exr") + " --as magic", 2, "camera-texture"},
             {"convert " + wall() + " " + file("a.pfm") + " --as camera-texture", 2, ".exr"},
             {"convert " + wall() + " " + file("a.json") + " --as pfm", 2, ".json"},
             {"convert " + wall() + " " + file("a.exr") + " --as camera-texture", 2, "surface-map"},
             {"convert " + wall() + " " + file("a.exr") + " --grid 1x5", 2, "--grid"},
             {"convert " + wall() + " " + file("a.mpcdi") + " --grid 5x5", 2, "--grid"},
             {"convert " + wall() + " " + file("a.exr") + " --display middle", 2, "left, right"},
             {"convert " + wall() + " " + file("a.exr") + " --eye 0,0,2", 2, "not inside the cylinder"},
             {"convert " + wall() + " " + file("wall.exr"), 2, "wall.json is the input"},
             {"convert " + file("none.json") + " " + file("a.exr"), 3, "none.json"},
             {"convert " + wall() + " " + file("no/such/folder.exr"), 1, "there is no folder"},
         }) {
        const Outcome outcome = run("", c.arguments);
        EXPECT_EQ(outcome.exitCode, c.exitCode) << c.arguments << "\n" << outcome.output;
        EXPECT_THAT(outcome.output, HasSubstr(c.says));
    }
}

TEST_F(Program, WithoutOpenGlItSaysSoAndTheReferenceStillRenders) {
    const std::string noDriver = "__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent";
    EXPECT_EQ(run(noDriver, "render " + wall() + " --scene room").exitCode, 4);
    EXPECT_EQ(run(noDriver, "render " + wall() + " --scene room --method reference").exitCode, 0);
}

}  // namespace
}  // namespace curvewall
