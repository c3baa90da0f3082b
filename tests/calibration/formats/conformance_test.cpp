// Every case of tests/data/conformance: a tiny file for one rule of one format, and the rays that it stands
// for.

#include "calibration/errors.h"
#include "calibration/files/json_file.h"
#include "calibration/formats/calibration_file.h"
#include "calibration/readers/grid_reader.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace curvewall {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

const fs::path kFolder = fs::path(CURVEWALL_SOURCE_DIR) / "tests" / "data" / "conformance";

struct Case {
    fs::path path;
    json content;

    fs::path file() const { return path.parent_path() / content.at("file").get<std::string>(); }
};

// JSON files are cases where they have a rule, and else files that a case names.
std::vector<Case> allCases() {
    std::vector<Case> cases;
    for (const auto& entry : fs::recursive_directory_iterator(kFolder)) {
        if (entry.path().extension() != ".json") continue;
        std::ifstream in(entry.path());
        json content = json::parse(in, nullptr, false);
        if (content.is_object() && content.contains("rule")) cases.push_back({entry.path(), content});
    }
    std::ranges::sort(cases, {}, &Case::path);
    return cases;
}

std::string nameOf(const testing::TestParamInfo<Case>& info) {
    std::string name = fs::relative(info.param.path, kFolder).replace_extension().string();
    std::ranges::replace_if(
        name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

CalibrationRequest requestOf(const Case& c) {
    CalibrationRequest request;
    if (c.content.contains("size")) request.sizePx = {c.content["size"][0], c.content["size"][1]};
    if (c.content.contains("eye"))
        request.eyeM = {c.content["eye"][0], c.content["eye"][1], c.content["eye"][2]};
    if (c.content.contains("source")) {
        JsonFields source(c.content["source"], "source");
        std::vector<std::string> files;
        request.source = readSource(source, {{c.path.parent_path(), files}, {}, glm::ivec2(0)});
    }
    request.display = c.content.value("display", "");
    return request;
}

Wall readCase(const Case& c) {
    Decisions decisions(c.content.value("assume", json::object()));
    const std::string path = c.file().string();
    Wall wall =
        readCalibration(readFile(path, "a file of the set"), filesBeside(path), requestOf(c), decisions);
    decisions.refuseUnusedKeys();
    return wall;
}

void expectRays(const Case& c, const Display& display) {
    const double tolerance = c.content.value("tolerance", 1e-6);
    for (const json& expected : c.content.value("rays", json::array())) {
        const glm::dvec2 px(expected["px"][0], expected["px"][1]);
        const auto ray = display.projection->unproject(px);
        SCOPED_TRACE(expected.dump());
        ASSERT_EQ(ray.has_value(), !expected["ray"].is_null());
        if (!ray) continue;
        const glm::dvec3 truth(expected["ray"][0], expected["ray"][1], expected["ray"][2]);
        const double angle = std::atan2(glm::length(glm::cross(*ray, truth)), glm::dot(*ray, truth));
        EXPECT_LT(angle, tolerance) << "read (" << ray->x << ", " << ray->y << ", " << ray->z << ")";
    }
}

void expectAssumptions(const Case& c, const Display& display) {
    const json assumptions = c.content.value("assumptions", json::object());
    for (const auto& [key, value] : assumptions.items()) {
        const auto found = std::ranges::find(display.assumptions, key, &Assumption::key);
        ASSERT_NE(found, display.assumptions.end()) << "nothing was assumed of " << key;
        EXPECT_EQ(found->value, value.get<std::string>()) << key;
    }
}

class Conformance : public testing::TestWithParam<Case> {};

TEST_P(Conformance, FileMeansWhatItsRuleSays) {
    const Case& c = GetParam();
    SCOPED_TRACE(c.content["rule"].get<std::string>());
    ASSERT_TRUE(fs::is_regular_file(c.file())) << c.file();
    if (c.content.contains("error")) {
        try {
            readCase(c);
            FAIL() << "the file was read";
        } catch (const InputError& error) {
            EXPECT_THAT(error.what(), HasSubstr(c.content["error"].get<std::string>()));
        }
        return;
    }
    const Wall wall = readCase(c);
    ASSERT_EQ(wall.displays.size(), 1U) << "name one display";
    const Display& display = wall.displays.front();
    expectRays(c, display);
    expectAssumptions(c, display);
    if (c.content.contains("warning")) {
        EXPECT_THAT(display.warnings, testing::Contains(HasSubstr(c.content["warning"].get<std::string>())));
    }
}

// A case that checks nothing is a mistake, and so is a key that the runner does not know.
TEST_P(Conformance, CaseIsWellFormed) {
    const Case& c = GetParam();
    for (const auto& [key, value] : c.content.items())
        EXPECT_THAT(key, testing::AnyOf("rule", "file", "size", "display", "assume", "eye", "source", "rays",
                                        "tolerance", "assumptions", "warning", "error"));
    EXPECT_TRUE(c.content.contains("rays") || c.content.contains("error") || c.content.contains("warning") ||
                c.content.contains("assumptions"));
}

INSTANTIATE_TEST_SUITE_P(Files, Conformance, testing::ValuesIn(allCases()), nameOf);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Conformance);

}  // namespace
}  // namespace curvewall
