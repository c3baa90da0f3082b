// `curvewall report` as a shell sees it.

#include "tests/cli/program_run.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace curvewall {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

class ReportProgram : public test::GlTest {
protected:
    void SetUp() override {
        test::GlTest::SetUp();
        wall_ = folder_.write("wall.json", R"({"wall": "small", "displays": [
            {"name": "left", "size": [64, 48],
             "projection": {"type": "cylinder", "radius": 2, "arc_deg": 90, "height": 2}},
            {"name": "right", "size": [64, 48],
             "projection": {"type": "planar", "lower_left": [-1, -1, -1], "lower_right": [1, -1, -1],
                            "upper_left": [-1, 1, -1]}}]})");
    }
    std::string file(const std::string& name) const { return folder_.path(name); }
    std::string text(const std::string& name) const {
        std::ifstream stream(file(name));
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    test::TemporaryFolder folder_;
    std::string wall_;
};

TEST_F(ReportProgram, WritesPagesThatSayWhichMethodToUse) {
    const std::string command =
        "report " + wall_ + " --display left --scene room --quick --rounds 1 --frames 1 --out " + file("out");
    const test::Outcome outcome = test::runProgram(command);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr("left: "));
    EXPECT_THAT(text("out/report.md"), HasSubstr("Use `"));
    const json report = json::parse(text("out/report.json"));
    ASSERT_EQ(report["views"].size(), 1u);
    EXPECT_EQ(report["views"][0]["display"], "left");
    EXPECT_GE(report["views"][0]["settings"].size(), 10u);
    const std::string page = text("out/report.html");
    EXPECT_THAT(page, HasSubstr("<svg"));
    EXPECT_THAT(page, HasSubstr("data:image/png;base64,"));
    for (const char* fetched : {"src=\"http", "href=\"http", "src=\"pictures", "src=\"plots"})
        EXPECT_THAT(page, Not(HasSubstr(fetched)));
    EXPECT_FALSE(std::filesystem::is_empty(file("out/plots")));

    // What is there is not measured again: no file of a measurement is touched.
    const auto written = std::filesystem::last_write_time(file("out/measured"));
    ASSERT_EQ(test::runProgram(command).exitCode, 0);
    EXPECT_EQ(std::filesystem::last_write_time(file("out/measured")), written);
    EXPECT_EQ(json::parse(text("out/report.json")), report);
}

TEST_F(ReportProgram, SaysWhatItNeeds) {
    const auto messageOf = [&](const std::string& arguments) {
        const test::Outcome outcome = test::runProgram("report --out " + file("out") + " " + arguments);
        EXPECT_EQ(outcome.exitCode, 2) << outcome.output;
        return outcome.output;
    };
    EXPECT_THAT(messageOf(""), HasSubstr("report needs a WALL, or --suite hard-cases"));
    EXPECT_THAT(messageOf(wall_), HasSubstr("report needs a --scene"));
    EXPECT_THAT(messageOf(wall_ + " --scene room --display middle"), HasSubstr("left"));
    EXPECT_THAT(messageOf(wall_ + " --scene room --display left --display rigth"), HasSubstr("rigth"));
    EXPECT_THAT(messageOf(wall_ + " --scene room --suite hard-cases"), HasSubstr("its own walls"));
    for (const std::string option :
         {"--camera 0,0,0", "--eye 0,0,0", "--tolerance 0.25", "--display left", "--size 64x48",
          "--style unlit", "--rounds 3", "--frames 3", "--references truth"})
        EXPECT_THAT(messageOf("--suite hard-cases --quick " + option),
                    HasSubstr("takes no " + option.substr(0, option.find(' '))));
    EXPECT_THAT(messageOf(wall_ + " --suite hard-cases"), HasSubstr("takes no WALL"));
    EXPECT_THAT(messageOf("--suite soft-cases"), HasSubstr("hard-cases"));
    EXPECT_THAT(messageOf(wall_ + " --scene room --rounds 0"), HasSubstr("--rounds"));
    EXPECT_FALSE(std::filesystem::exists(file("out")));
}

TEST_F(ReportProgram, BadInputIsNamed) {
    const test::Outcome scene =
        test::runProgram("report " + wall_ + " --scene " + file("missing.glb") + " --out " + file("out"));
    EXPECT_EQ(scene.exitCode, 3) << scene.output;
    EXPECT_THAT(scene.output, HasSubstr("missing.glb"));
    const test::Outcome folder =
        test::runProgram("report " + wall_ + " --scene room --out " + wall_ + "/report");
    EXPECT_EQ(folder.exitCode, 1) << folder.output;
    EXPECT_THAT(folder.output, HasSubstr("cannot be made a folder"));
}

}  // namespace
}  // namespace curvewall
