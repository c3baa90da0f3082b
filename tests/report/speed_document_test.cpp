#include "report/speed_document.h"

#include "report/advice.h"
#include "report/recommendation.h"
#include "report/speed_plots.h"
#include "tests/report/made_up_report.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <pugixml.hpp>
#include <set>

namespace curvewall {
namespace {

using test::madeUpSetting;
using ::testing::HasSubstr;
using ::testing::Not;

ViewReport viewOf(std::vector<SettingResult> settings) {
    ViewReport view;
    view.wall = "wall";
    view.display = "front";
    view.scene = "city";
    view.sizePx = {1000, 1000};
    view.settings = std::move(settings);
    return view;
}

SettingResult refused(const std::string& method, const std::string& reason) {
    SettingResult result;
    result.setting = {method, "", "", 0, 1};
    result.refusal = reason;
    return result;
}

SettingResult pieces(double tolerancePx, double ms) {
    SettingResult result =
        madeUpSetting("piecewise", "", "tolerance_px", tolerancePx, 0.99 * tolerancePx, ms);
    result.stats["pieces"] = 1673;
    return result;
}

SettingResult faces(double sizePx, double errorPx, double ms) {
    return madeUpSetting("image-based", "cube, linear", "face_size_px", sizePx, errorPx, ms);
}

std::string adviceText(const ViewReport& view, double tolerancePx = 0.25) {
    SpeedReport report;
    report.tolerancePx = tolerancePx;
    report.views = {view};
    std::string text;
    for (const Block& block : adviceOf(report)) {
        if (const auto* paragraph = std::get_if<Paragraph>(&block)) text += paragraph->text + "\n";
        if (const auto* list = std::get_if<List>(&block))
            for (const std::string& item : list->items) text += item + "\n";
    }
    return text;
}

TEST(Recommendation, IsTheFastestThatKeepsTheTolerance) {
    const ViewReport view =
        viewOf({pieces(0.25, 62), pieces(0.1, 70), faces(1024, 1, 30), faces(4096, 0.2, 190),
                madeUpSetting("vertex-warp", "", "tessellation_px", 8, 0.2, 100)});
    const Recommendation answer = recommend(view, 0.25);
    EXPECT_EQ(answer.best, &view.settings[0]);
    EXPECT_EQ(answer.halfError, &view.settings[1]);
    EXPECT_THAT(answer.others, ::testing::ElementsAre(&view.settings[4], &view.settings[3]));
    EXPECT_TRUE(answer.missing.empty());
}

TEST(Recommendation, IsNeitherTheReferenceNorOfSeveralSamples) {
    ViewReport view = viewOf({madeUpSetting("reference", "", "samples", 1, 0, 1), pieces(0.25, 2)});
    view.settings[1].setting.samples = 4;
    const Recommendation answer = recommend(view, 0.25);
    EXPECT_EQ(answer.best, nullptr);
    EXPECT_TRUE(answer.missing.empty());
    EXPECT_TRUE(answer.refusing.empty());
}

TEST(Recommendation, LeavesNoPixelsOpen) {
    ViewReport view = viewOf({pieces(0.25, 62), faces(4096, 0.2, 190)});
    const auto best = [&] { return recommend(view, 0.25).best; };
    view.settings[0].errors.coverage.uncoveredPixels = 5;  // of a million
    EXPECT_EQ(best(), &view.settings[0]);
    view.settings[0].errors.coverage.uncoveredPixels = 500;
    EXPECT_EQ(best(), &view.settings[1]);
    view.settings[0].errors.coverage.uncoveredPixels = 0;
    view.settings[0].room.twiceCoveredPixels = 500;
    EXPECT_EQ(best(), &view.settings[1]);
    view.settings[1].errors.misplacedPixels = 500;
    EXPECT_EQ(best(), nullptr);
}

TEST(Recommendation, NeverMissesATolerance) {
    const SpeedReport report = test::madeUpReport();
    for (const ViewReport& view : report.views)
        for (const double tolerancePx : {0.01, 0.06, 0.1, 0.25, 0.5, 1.0, 3.0}) {
            const Recommendation answer = recommend(view, tolerancePx);
            for (const SettingResult& result : view.settings)
                if (keeps(result, tolerancePx, view.sizePx)) {
                    ASSERT_NE(answer.best, nullptr);
                    EXPECT_LE(answer.best->frameMs.median, result.frameMs.median);
                    EXPECT_LE(answer.best->errors.geometric.maxPx, tolerancePx + 0.003);
                }
        }
}

TEST(Advice, SaysWhatToUseAndWhatItCosts) {
    const std::string text =
        adviceText(viewOf({pieces(0.25, 62), pieces(0.1, 77.5), faces(4096, 0.24, 190), faces(512, 2, 20)}));
    EXPECT_THAT(text,
                HasSubstr("Use `piecewise` at 0.25 px: 1,673 pieces, 62 ms a frame, at most 0.247 px off."));
    EXPECT_THAT(text, HasSubstr("the next is `image-based` (cube, linear) with faces of 4,096 px: 190 ms, "
                                "3.1 times as long."));
    EXPECT_THAT(
        text,
        HasSubstr("Half the error, 0.125 px, costs `piecewise` at 0.1 px: 77.5 ms, 1.2 times as long."));
    EXPECT_THAT(text, Not(HasSubstr("faulty")));
}

TEST(Advice, SaysWhereNothingKeepsTheTolerance) {
    const std::string text = adviceText(viewOf({faces(1024, 1.5, 30), faces(4096, 0.36, 190)}));
    EXPECT_THAT(text, HasSubstr("Nothing that was measured keeps 0.25 px here."));
    EXPECT_THAT(text, HasSubstr("with faces of 4,096 px comes to 0.36 px in 190 ms"));
    EXPECT_THAT(text, Not(HasSubstr("Use ")));
}

TEST(Advice, SaysWhatElseThereIsNot) {
    const std::string text = adviceText(
        viewOf({pieces(0.25, 62), refused("bounded-raycast", "no"), refused("vertex-warp", "no")}));
    EXPECT_THAT(text, HasSubstr("No other method keeps 0.25 px here."));
    EXPECT_THAT(text, HasSubstr("Nothing keeps half the error, 0.125 px."));
    EXPECT_THAT(text, HasSubstr("`bounded-raycast` and `vertex-warp` do not draw this display"));
}

TEST(Advice, CountsWhatIsCoveredWrongly) {
    ViewReport view = viewOf({pieces(0.25, 62)});
    view.settings[0].errors.coverage.uncoveredPixels = 1;
    EXPECT_THAT(adviceText(view), HasSubstr("off. 1 faulty pixel."));
    view.settings[0].errors.coverage.uncoveredPixels = 3000;
    EXPECT_THAT(adviceText(view), HasSubstr("comes to 0.247 px in 62 ms, with 3,000 faulty pixels"));
}

TEST(SpeedDocument, HasPlotsAndTablesOfEveryView) {
    const Document document = speedDocument(test::madeUpReport());
    size_t plots = 0, rows = 0, emphasized = 0;
    std::set<std::string> files;
    for (const Block& block : document.blocks) {
        if (const auto* plot = std::get_if<PlotFigure>(&block)) {
            ++plots;
            EXPECT_TRUE(files.insert(plot->picture.file).second);
            EXPECT_FALSE(plot->plot.front.empty());
        }
        const auto* table = std::get_if<Table>(&block);
        if (!table) continue;
        for (const std::vector<std::string>& row : table->rows) EXPECT_EQ(row.size(), table->columns.size());
        if (table->columns[0] != "setting" || table->columns[1] != "ms") continue;
        rows += table->rows.size();
        emphasized += table->emphasized.size();
    }
    EXPECT_EQ(plots, 6u);  // nothing is known in flat colours
    EXPECT_EQ(rows, 20u + 10u);
    EXPECT_EQ(emphasized, 2u);
    EXPECT_THAT(markdownOf(document),
                HasSubstr("`bounded-raycast, triangle`: bounded-raycast draws round lenses"));
}

TEST(SpeedDocument, PlotsShowEachMethodAndNotTooManyCurves) {
    SpeedReport report = test::madeUpReport();
    for (int i = 0; i < 30; ++i)
        report.views[0].settings.push_back(
            madeUpSetting("image-based", "variant " + std::to_string(i), "face_size_px", 512, 3, 500 + i));
    for (const Block& block : speedDocument(report).blocks) {
        const auto* figure = std::get_if<PlotFigure>(&block);
        if (!figure || !figure->plot.title.starts_with("dome")) continue;
        EXPECT_LE(figure->plot.curves.size(), 10u);
        for (const char* name :
             {"piecewise", "vertex-warp", "bounded-raycast, triangle", "image-based, cube, linear"})
            EXPECT_EQ(std::ranges::count(figure->plot.curves, name, &Curve::name), 1) << name;
    }
}

std::string captionOf(const ViewReport& view, const std::string& fileEnd) {
    for (const Block& block : speedPlots(view, 0.25, "plot"))
        if (const auto* figure = std::get_if<PlotFigure>(&block);
            figure && figure->picture.file.ends_with(fileEnd))
            return figure->picture.caption;
    return "no such plot";
}

TEST(SpeedPlots, NameSettingsWithoutErrorThatALogarithmicAxisHasNoPlaceFor) {
    ViewReport view = test::madeUpReport().views[0];
    EXPECT_THAT(captionOf(view, "wrong-pixels.png"), Not(HasSubstr("Not shown")));
    view.settings[0].errors.image.shareOff = 0;
    view.settings[2].errors.image.shareOff = 0;
    EXPECT_THAT(captionOf(view, "wrong-pixels.png"),
                HasSubstr("Not shown, with an error of 0: `piecewise` at 2 px; `piecewise` at 0.5 px."));
    for (size_t i = 0; i < 6; ++i) view.settings[i].errors.image.shareOff = 0;
    EXPECT_THAT(captionOf(view, "wrong-pixels.png"), HasSubstr("`piecewise` at 0.25 px; and 2 more."));
    EXPECT_THAT(captionOf(view, "geometric.png"), Not(HasSubstr("Not shown")));
}

TEST(SpeedPlots, NameAFloorThatALogarithmicAxisHasNoPlaceFor) {
    ViewReport view = test::madeUpReport().views[0];
    for (SettingResult& result : view.settings) result.edges = ImageDifference{0.01, 40, 1, 10};
    EXPECT_THAT(captionOf(view, "wrong-edges.png"),
                HasSubstr("No line shows the floor of sampling, which is 0."));
    view.floors[0].edgesOff = 0.001;
    EXPECT_THAT(captionOf(view, "wrong-edges.png"), Not(HasSubstr("No line")));
}

TEST(SpeedPlots, SayWhereNothingHasAWrongEdge) {
    ViewReport view = test::madeUpReport().views[0];
    const auto notes = [&view] {
        std::string text;
        for (const Block& block : speedPlots(view, 0.25, "plot"))
            if (const auto* paragraph = std::get_if<Paragraph>(&block)) text += paragraph->text;
        return text;
    };
    EXPECT_EQ(notes(), "");  // nothing is known in flat colours
    for (SettingResult& result : view.settings) result.edges = ImageDifference{0, 99, 1, 0};
    EXPECT_THAT(notes(), HasSubstr("No setting has a wrong edge"));
    EXPECT_EQ(captionOf(view, "wrong-edges.png"), "no such plot");
    view.settings[3].edges->shareOff = 0.01;
    EXPECT_EQ(notes(), "");
    EXPECT_THAT(captionOf(view, "wrong-edges.png"), HasSubstr("and 15 more"));
}

TEST(SpeedPlots, LeaveOutWhatHasNoSuchNumber) {
    ViewReport view = test::madeUpReport().views[0];
    for (SettingResult& result : view.settings)
        if (result.setting.method == "piecewise") result.edges = ImageDifference{0.01, 40, 1, 10};
    EXPECT_THAT(captionOf(view, "wrong-edges.png"), Not(HasSubstr("Not shown")));
}

TEST(SpeedDocument, IsAPage) {
    const test::TemporaryFolder folder;
    pugi::xml_document page;
    ASSERT_TRUE(page.load_string(htmlOf(speedDocument(test::madeUpReport()), folder.path()).c_str()));
    EXPECT_EQ(page.select_nodes("//*[local-name()='svg']").size(), 6u);
}

TEST(SpeedDocument, OfNothingIsThereAllTheSame) {
    EXPECT_NE(markdownOf(speedDocument({})), "");
    SpeedReport report;
    report.views = {viewOf({}), viewOf({refused("piecewise", "no")})};
    const std::string text = markdownOf(speedDocument(report));
    EXPECT_THAT(text, HasSubstr("`piecewise` does not draw this display"));
}

}  // namespace
}  // namespace curvewall
