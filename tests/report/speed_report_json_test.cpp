#include "report/speed_report_json.h"

#include "tests/report/made_up_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace curvewall {
namespace {

using nlohmann::json;

SpeedReport again(const SpeedReport& report) { return json::parse(json(report).dump()).get<SpeedReport>(); }

// 1/3 and the like have no short decimal form.
SpeedReport crookedReport() {
    SpeedReport report = test::madeUpReport();
    for (ViewReport& view : report.views) {
        view.truth.noiseDb = std::sqrt(1500);
        for (SettingResult& result : view.settings) {
            result.setting.value /= 3;
            result.errors.geometric.maxPx /= 7;
            result.errors.geometric.maxAt = {13, 17};
            result.errors.image.ssim = std::nextafter(1.0, 0.0);
            result.frameMs = {std::sqrt(2), 0x1.fp-1074, std::numeric_limits<double>::max()};
            result.stats["odd"] = 0.1 + 0.2;
            result.picture = "a.png";
            result.crop = "b.png";
            result.errorMap = "c.png";
        }
    }
    return report;
}

TEST(SpeedReportJson, ComesBackToTheLastDigit) {
    const SpeedReport report = crookedReport(), back = again(report);
    ASSERT_EQ(back.views.size(), report.views.size());
    EXPECT_EQ(json(back), json(report));
    EXPECT_EQ(back.glRenderer, report.glRenderer);
    EXPECT_EQ(back.processor, report.processor);
    EXPECT_EQ(back.tolerancePx, report.tolerancePx);
    const ViewReport &view = report.views[0], &backView = back.views[0];
    EXPECT_EQ(backView.wall, view.wall);
    EXPECT_EQ(backView.display, view.display);
    EXPECT_EQ(backView.scene, view.scene);
    EXPECT_EQ(backView.sizePx, view.sizePx);
    EXPECT_EQ(backView.projection, view.projection);
    EXPECT_EQ(backView.truth.supersamples, view.truth.supersamples);
    EXPECT_EQ(backView.truth.noiseDb, view.truth.noiseDb);
    EXPECT_EQ(backView.truth.crop, view.truth.crop);
    ASSERT_EQ(backView.floors.size(), view.floors.size());
    EXPECT_EQ(backView.floors[0].shareOff, view.floors[0].shareOff);
    ASSERT_EQ(backView.settings.size(), view.settings.size());
    const SettingResult &result = view.settings[0], &backResult = backView.settings[0];
    EXPECT_EQ(backResult.setting.curve(), result.setting.curve());
    EXPECT_EQ(backResult.setting.value, result.setting.value);
    EXPECT_EQ(backResult.errors.geometric.maxPx, result.errors.geometric.maxPx);
    EXPECT_EQ(backResult.errors.geometric.maxAt, result.errors.geometric.maxAt);
    EXPECT_EQ(backResult.errors.image.ssim, result.errors.image.ssim);
    EXPECT_EQ(backResult.frameMs.median, result.frameMs.median);
    EXPECT_EQ(backResult.frameMs.min, result.frameMs.min);
    EXPECT_EQ(backResult.frameMs.max, result.frameMs.max);
    EXPECT_EQ(backResult.stats, result.stats);
    EXPECT_EQ(backResult.picture, result.picture);
    EXPECT_EQ(backResult.crop, result.crop);
    EXPECT_EQ(backResult.errorMap, result.errorMap);
}

TEST(SpeedReportJson, InfinitePsnrIsNullThere) {
    SpeedReport report = test::madeUpReport();
    MethodErrors& errors = report.views[0].settings[0].errors;
    errors.image.psnrDb = errors.supersampledPsnrDb = std::numeric_limits<double>::infinity();
    const json written = json::parse(json(report).dump());
    EXPECT_TRUE(written["views"][0]["settings"][0]["errors"]["image"]["psnr_db"].is_null());
    const MethodErrors back = again(report).views[0].settings[0].errors;
    EXPECT_EQ(back.image.psnrDb, std::numeric_limits<double>::infinity());
    EXPECT_EQ(back.supersampledPsnrDb, std::numeric_limits<double>::infinity());
}

TEST(SpeedReportJson, RefusalsHaveNoFigures) {
    SettingResult refused;
    refused.setting = {"bounded-raycast", "triangle", "", 0, 1};
    refused.refusal = "not a round lens";
    const json written = refused;
    EXPECT_FALSE(written.contains("errors"));
    EXPECT_EQ(written.get<SettingResult>().refusal, "not a round lens");
}

TEST(SpeedReportJson, NothingMeasuredComesBackToo) {
    EXPECT_TRUE(again({}).views.empty());
    SpeedReport report;
    report.views.resize(1);
    EXPECT_TRUE(again(report).views.at(0).settings.empty());
}

}  // namespace
}  // namespace curvewall
