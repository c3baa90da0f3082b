// The program as a shell sees it: exit codes, messages, files.

#include "renderer/image_file.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>

namespace curvewall {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

struct Outcome {
    int exitCode = -1;
    std::string output;  // stdout and stderr
};

Outcome run(const std::string& environment, const std::string& arguments) {
    const std::string command = environment + " '" CURVEWALL_EXECUTABLE "' " + arguments + " 2>&1";
    FILE* pipe = popen(command.c_str(), "r");
    Outcome outcome;
    char buffer[4096];
    while (const size_t bytes = fread(buffer, 1, sizeof buffer, pipe)) outcome.output.append(buffer, bytes);
    const int status = pclose(pipe);
    outcome.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
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
             {render + "--method magic", 2, "piecewise, image-based or reference"},
             {render + "--style cubist", 2, "textured or unlit"},
             {render + "--engine loop", 2, "compute"},
             {render + "--display middle", 2, "left, right"},
             {render + "--camera 1,2", 2, "x,y,z"},
             {render + "--out a.gif", 2, ".gif"},
             {render + "--output-kind depth --out a.png", 2, ".exr"},
             {"render " + wall() + " --scene city:999", 2, "1000"},
             {"render " + file("none.json") + " --scene room", 3, "none.json"},
             {"render " + wall() + " --scene " + file("none.glb"), 3, "none.glb"},
             {"render " + wall() + " --scene " + wall(), 3, "wall.json"},
             {render + "--out " + file("no/such/folder.png"), 1, "there is no folder"},
             {"serve " + file("none.json"), 3, "none.json"},
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
