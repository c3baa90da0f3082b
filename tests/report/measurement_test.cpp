#include "report/measurement.h"

#include "renderer/scene/load_scene.h"
#include "report/error_orders.h"
#include "report/speed_report_json.h"
#include "report/view_measurement.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/rendering.h"
#include "tests/support/small_walls.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace curvewall {
namespace {

MeasurementPlan planFor(const std::string& wall, const test::TemporaryFolder& folder) {
    RenderRequest request;
    request.wall = std::make_shared<const Wall>(test::smallShippedWall(wall, 8));
    request.display = request.wall->displays.front().name;
    request.scene = std::make_shared<const Scene>(loadScene("city:4000"));
    request.camera = request.scene->defaultCamera;
    MeasurementPlan plan;
    plan.views = {{request, wall, "city"}};
    plan.extent = Extent::quick;
    plan.rounds = plan.frames = 1;
    plan.folder = folder.path();
    plan.references = folder.path("references");
    return plan;
}

const auto kQuietly = [](const Progress&) {};

// All that a repetition must give again to the last digit.
std::map<std::string, nlohmann::json> errorsByName(const SpeedReport& report) {
    std::map<std::string, nlohmann::json> errors;
    for (const SettingResult& result : report.views.at(0).settings) {
        nlohmann::json json = result;
        errors[result.setting.text()] = {json.value("refused", ""), json["errors"], json["edges"],
                                         json["closed_room"]};
    }
    return errors;
}

class Measurements : public test::GlTest {};

TEST_F(Measurements, GiveTheSameErrorsToTheLastDigitWhenRepeated) {
    const test::TemporaryFolder first, second;
    EXPECT_EQ(errorsByName(measureSpeed(planFor("camera-texture", first), kQuietly)),
              errorsByName(measureSpeed(planFor("camera-texture", second), kQuietly)));
}

struct Interruption : std::runtime_error {
    using std::runtime_error::runtime_error;
};

std::map<std::string, std::filesystem::file_time_type> writtenIn(const std::string& folder) {
    std::map<std::string, std::filesystem::file_time_type> times;
    for (const auto& entry : std::filesystem::directory_iterator(folder + "/measured"))
        times[entry.path().string()] = entry.last_write_time();
    return times;
}

TEST_F(Measurements, GoOnWhereTheyWereInterrupted) {
    const test::TemporaryFolder folder;
    const MeasurementPlan plan = planFor("full-cylinder", folder);
    const size_t settings = settingsFor(plan.views[0].request, Extent::quick).size();
    EXPECT_THROW(measureSpeed(plan,
                              [&](const Progress& progress) {
                                  if (progress.done == settings) throw Interruption("power cut");
                              }),
                 Interruption);
    const auto before = writtenIn(plan.folder);
    EXPECT_GE(before.size(), settings - 2);

    const SpeedReport report = measureSpeed(plan, kQuietly);
    const auto after = writtenIn(plan.folder);
    for (const auto& [file, time] : before) EXPECT_EQ(after.at(file), time) << file;
    for (const SettingResult& result : report.views[0].settings)
        EXPECT_TRUE(!result.refusal.empty() || result.frameMs.median > 0) << result.setting.text();
}

TEST_F(Measurements, ADamagedFileIsMeasuredAgain) {
    const test::TemporaryFolder folder;
    MeasurementPlan plan = planFor("planar-90", folder);
    const auto wanted = errorsByName(measureSpeed(plan, kQuietly));
    for (const auto& [file, time] : writtenIn(plan.folder)) std::filesystem::resize_file(file, 7);
    EXPECT_EQ(errorsByName(measureSpeed(plan, kQuietly)), wanted);
}

TEST_F(Measurements, CountTheirSteps) {
    const test::TemporaryFolder folder;
    const MeasurementPlan plan = planFor("planar-90", folder);
    size_t calls = 0, all = 0;
    measureSpeed(plan, [&](const Progress& progress) {
        EXPECT_EQ(progress.done, calls++);
        EXPECT_GT(progress.leftMs, 0);
        all = progress.all;
    });
    EXPECT_EQ(calls, all);
}

TEST_F(Measurements, TellNoTimeForWhatIsKept) {
    const test::TemporaryFolder folder;
    MeasurementPlan plan = planFor("planar-90", folder);
    const size_t settings = measureSpeed(plan, kQuietly).views[0].settings.size();
    std::vector<double> leftMs;
    const auto note = [&](const Progress& progress) { leftMs.push_back(progress.leftMs); };
    measureSpeed(plan, note);
    const double picturesMs = leftMs.back();
    EXPECT_THAT(leftMs, ::testing::Each(picturesMs));

    plan.rounds = 2;
    leftMs.clear();
    measureSpeed(plan, note);
    const size_t secondRound = leftMs.size() - 1 - settings;
    EXPECT_GT(leftMs.front(), picturesMs);
    for (size_t i = 0; i <= secondRound; ++i) EXPECT_EQ(leftMs[i], leftMs.front());
}

TEST_F(Measurements, OfAnotherDriverAreNotShared) {
    const test::TemporaryFolder folder;
    const MeasurementPlan plan = planFor("planar-90", folder);
    measureSpeed(plan, kQuietly);
    const GlDriver same = glDriver();
    const auto areKept = [&](const GlDriver& driver) {
        for (const Step& step : ViewMeasurement(plan.views[0], plan, driver).steps())
            if (step.kind == StepKind::errors && !step.isKept) return false;
        return true;
    };
    EXPECT_TRUE(areKept(same));
    EXPECT_FALSE(areKept({same.renderer, same.version + "1"}));
    EXPECT_FALSE(areKept({same.renderer + "1", same.version}));
}

// Small triangles in flat colours: edges fall as geometry does, down to what chance decides.
class FallingErrors : public test::GlTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(FallingErrors, FollowTheKnobAtTheExpectedOrder) {
    const test::TemporaryFolder folder;
    const SpeedReport report = measureSpeed(planFor(GetParam(), folder), kQuietly);
    std::map<std::string, double> geometric;
    std::set<std::string> edges;
    for (const ErrorOrder& order : errorOrders(report.views[0])) {
        SCOPED_TRACE(order.curve + ": " + order.error);
        if (order.error == "geometric, 99 in 100") {
            geometric[order.curve] = order.order;
            EXPECT_NEAR(order.order / order.expected, 1, 0.3);
        }
        if (order.error == "wrong edges") {
            edges.insert(order.curve);
            EXPECT_GT(order.order / order.expected, 0.4);  // kinks of measured maps
        }
    }
    EXPECT_THAT(geometric, ::testing::Contains(::testing::Key("piecewise")));
    EXPECT_THAT(geometric, ::testing::Contains(::testing::Key("image-based, cube, nearest")));
    EXPECT_THAT(geometric, ::testing::Contains(::testing::Key("vertex-warp")));
    EXPECT_THAT(edges, ::testing::Contains("piecewise"));
    EXPECT_THAT(edges, ::testing::Contains("image-based, cube, nearest"));
    EXPECT_THAT(edges, ::testing::Contains("vertex-warp"));
    for (const SettingResult& result : report.views[0].settings) {
        if (!result.refusal.empty()) continue;
        SCOPED_TRACE(result.setting.text());
        EXPECT_EQ(coverageFaults(result), 0u);
        EXPECT_EQ(result.errors.nanTexels, 0u);
        // Beyond the border of what a measured map knows there is no place, not even a pixel away.
        EXPECT_LE(result.errors.misplacedPixels, 4u);
    }
}

INSTANTIATE_TEST_SUITE_P(Walls, FallingErrors,
                         ::testing::Values("full-cylinder", "dome-master", "camera-texture"),
                         [](const auto& test) {
                             std::string name = test.param;
                             std::erase(name, '-');
                             return name;
                         });

}  // namespace
}  // namespace curvewall
