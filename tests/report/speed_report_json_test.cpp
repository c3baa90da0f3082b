#include "report/speed_report_json.h"

#include "tests/report/made_up_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace curvewall {
namespace {

using nlohmann::json;

template <class Value>
Value again(const Value& value) {
    return json::parse(json(value).dump()).template get<Value>();
}

// 1/3 and the like have no short decimal form.
TEST(SpeedReportJson, ResultsComeBackToTheLastDigit) {
    SettingResult result = test::madeUpReport().views[0].settings[0];
    result.setting.value /= 3;
    result.errors.geometric.maxPx /= 7;
    result.errors.geometric.maxAt = {13, 17};
    result.errors.image.ssim = std::nextafter(1.0, 0.0);
    result.edges = ImageDifference{1.0 / 7, std::sqrt(1500), 0.3, 8};
    result.frameMs = {std::sqrt(2), 0x1.fp-1074, std::numeric_limits<double>::max()};
    result.stats["odd"] = 0.1 + 0.2;
    result.picture = "a.png";
    result.crop = "b.png";
    result.errorMap = "c.png";
    const SettingResult back = again(result);
    EXPECT_EQ(json(back), json(result));
    EXPECT_EQ(back.setting.curve(), result.setting.curve());
    EXPECT_EQ(back.setting.value, result.setting.value);
    EXPECT_EQ(back.errors.geometric.maxPx, result.errors.geometric.maxPx);
    EXPECT_EQ(back.errors.geometric.maxAt, result.errors.geometric.maxAt);
    EXPECT_EQ(back.errors.image.ssim, result.errors.image.ssim);
    EXPECT_EQ(back.edges->psnrDb, result.edges->psnrDb);
    EXPECT_EQ(back.frameMs.median, result.frameMs.median);
    EXPECT_EQ(back.frameMs.min, result.frameMs.min);
    EXPECT_EQ(back.frameMs.max, result.frameMs.max);
    EXPECT_EQ(back.stats, result.stats);
    EXPECT_EQ(back.picture, result.picture);
    EXPECT_EQ(back.crop, result.crop);
    EXPECT_EQ(back.errorMap, result.errorMap);
}

TEST(SpeedReportJson, TruthAndFloorsComeBackToTheLastDigit) {
    const TruthFacts truth = again(TruthFacts{128, std::sqrt(1500), "a.png", "b.png"});
    EXPECT_EQ(truth.supersamples, 128);
    EXPECT_EQ(truth.noiseDb, std::sqrt(1500));
    EXPECT_EQ(truth.picture, "a.png");
    EXPECT_EQ(truth.crop, "b.png");
    const SamplingFloor floor = again(SamplingFloor{4, 1.0 / 3, 1.0 / 7, std::sqrt(2), std::sqrt(3)});
    EXPECT_EQ(floor.samples, 4);
    EXPECT_EQ(floor.shareOff, 1.0 / 3);
    EXPECT_EQ(floor.edgesOff, 1.0 / 7);
    EXPECT_EQ(floor.psnrDb, std::sqrt(2));
    EXPECT_EQ(floor.supersampledPsnrDb, std::sqrt(3));
}

TEST(SpeedReportJson, HasEveryViewWithItsSettings) {
    const SpeedReport report = test::madeUpReport();
    const json written = report;
    EXPECT_EQ(written["gl_renderer"], report.glRenderer);
    EXPECT_EQ(written["processor"], report.processor);
    EXPECT_EQ(written["tolerance_px"], report.tolerancePx);
    ASSERT_EQ(written["views"].size(), report.views.size());
    for (size_t i = 0; i < report.views.size(); ++i) {
        const ViewReport& view = report.views[i];
        const json& writtenView = written["views"][i];
        EXPECT_EQ(writtenView["wall"], view.wall);
        EXPECT_EQ(writtenView["display"], view.display);
        EXPECT_EQ(writtenView["scene"], view.scene);
        EXPECT_EQ(writtenView["size"], json::array({view.sizePx.x, view.sizePx.y}));
        EXPECT_EQ(writtenView["projection"], view.projection);
        EXPECT_EQ(writtenView["truth"], json(view.truth));
        EXPECT_EQ(writtenView["sampling_floors"], json(view.floors));
        EXPECT_EQ(writtenView["settings"], json(view.settings));
    }
}

TEST(SpeedReportJson, InfinitePsnrIsNullThere) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    MethodErrors errors = test::madeUpReport().views[0].settings[0].errors;
    errors.image.psnrDb = errors.supersampledPsnrDb = kInfinity;
    EXPECT_TRUE(json::parse(json(errors).dump())["image"]["psnr_db"].is_null());
    const MethodErrors back = again(errors);
    EXPECT_EQ(back.image.psnrDb, kInfinity);
    EXPECT_EQ(back.supersampledPsnrDb, kInfinity);
}

TEST(SpeedReportJson, RefusalsHaveNoFigures) {
    SettingResult refused;
    refused.setting = {"bounded-raycast", "triangle", "", 0, 1};
    refused.refusal = "not a round lens";
    const json written = refused;
    EXPECT_FALSE(written.contains("errors"));
    EXPECT_EQ(written.get<SettingResult>().refusal, "not a round lens");
}

}  // namespace
}  // namespace curvewall
