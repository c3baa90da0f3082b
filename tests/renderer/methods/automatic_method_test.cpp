#include "renderer/methods/automatic_method.h"

#include "calibration/errors.h"
#include "calibration/pieces/piece_fit.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/lens_walls.h"
#include "tests/support/rendering.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace curvewall {
namespace {

using ::testing::HasSubstr;

// So small that all methods should take about as long.
RenderRequest smallRequest(double tolerancePx = 1) {
    RenderRequest request =
        test::requestFor(test::lensWall({"Equidistant180", {RadialModel::equidistant}, 180}, glm::ivec2(32)),
                         loadScene("room"));
    request.camera = request.scene->defaultCamera;
    request.method = Method::automatic;
    request.tolerancePx = tolerancePx;
    request.pieces =
        std::make_shared<const FittedPieces>(fitPieces(request.wall->displays.front(), tolerancePx));
    return request;
}

// Stands for the other methods: notes what it is asked for and takes as long as it is told.
class Methods {
public:
    std::function<double(const RenderRequest&)> frameMs = [](const RenderRequest&) { return 1; };
    std::function<double(const RenderRequest&)> errorPx = [](const RenderRequest&) { return 0; };
    std::vector<RenderRequest> asked;

    AutomaticMethod::RenderSettled settled() {
        return [this](const RenderRequest& request) {
            asked.push_back(request);
            RenderResult result;
            result.stats.frameMsMedian = frameMs(request);
            result.stats.geometricError.maxPx = errorPx(request);
            return result;
        };
    }

    RenderResult render(AutomaticMethod& automatic, const RenderRequest& request) {
        return automatic.render(request, request.wall->displays.front(), settled());
    }
};

TEST(AutomaticMethod, TakesTheFastestOfThoseThatItTried) {
    AutomaticMethod automatic;
    Methods methods;
    const RenderRequest request = smallRequest();
    methods.render(automatic, request);
    ASSERT_GE(methods.asked.size(), 3u);  // two trials and what was asked for
    methods.asked.pop_back();
    for (const RenderRequest& tried : methods.asked) {
        const std::string fastest = settingsOf(tried);
        AutomaticMethod anew;
        Methods timed;
        timed.frameMs = [&](const RenderRequest& asked) { return settingsOf(asked) == fastest ? 1 : 2; };
        const RenderStats stats = timed.render(anew, request).stats;
        EXPECT_EQ(settingsOf(timed.asked.back()), fastest);
        EXPECT_EQ(stats.choice->forecasts.front().settings, fastest);
        EXPECT_EQ(stats.choice->forecasts.front().trialMs, 1);
        EXPECT_THAT(stats.choice->why, HasSubstr("1.0 ms a frame in trials"));
    }
}

TEST(AutomaticMethod, IsNotMisledByADisturbanceOfItsFirstTrial) {
    const RenderRequest request = smallRequest();
    AutomaticMethod automatic;
    Methods methods;
    std::string disturbed;
    methods.frameMs = [&](const RenderRequest& asked) {
        if (disturbed.empty()) disturbed = settingsOf(asked);
        if (settingsOf(asked) != disturbed) return 1.5;
        return asked.measuresError ? 1.9 : 1.0;  // only the first trial looks at errors
    };
    const RenderStats stats = methods.render(automatic, request).stats;
    EXPECT_EQ(stats.choice->forecasts.front().settings, disturbed);
    EXPECT_EQ(stats.choice->forecasts.front().trialMs, 1.0);
}

TEST(AutomaticMethod, RulesOutWhatMissesTheToleranceInATrial) {
    AutomaticMethod automatic;
    Methods methods;
    methods.frameMs = [](const RenderRequest& asked) { return asked.method == Method::piecewise ? 9 : 1; };
    methods.errorPx = [](const RenderRequest& asked) { return asked.method == Method::piecewise ? 1 : 7; };
    const RenderStats stats = methods.render(automatic, smallRequest()).stats;
    EXPECT_EQ(methods.asked.back().method, Method::piecewise);
    ASSERT_FALSE(stats.choice->ruledOut.empty());
    EXPECT_THAT(stats.choice->ruledOut, ::testing::Contains(HasSubstr("off by up to 7 px in a trial")));
    for (const RenderRequest& asked : methods.asked)
        if (&asked != &methods.asked.back()) {
            EXPECT_TRUE(asked.measuresError);
        }
}

TEST(AutomaticMethod, RulesOutWhatCannotDrawTheScene) {
    AutomaticMethod automatic;
    Methods methods;
    methods.frameMs = [](const RenderRequest& asked) {
        if (asked.method != Method::piecewise) throw UsageError("not this scene");
        return 5.0;
    };
    const RenderStats stats = methods.render(automatic, smallRequest()).stats;
    EXPECT_EQ(methods.asked.back().method, Method::piecewise);
    EXPECT_THAT(stats.choice->ruledOut,
                ::testing::Contains(HasSubstr("bounded-raycast, triangle: not this scene")));
}

TEST(AutomaticMethod, TriesOnceForAllCameras) {
    AutomaticMethod automatic;
    Methods methods;
    RenderRequest request = smallRequest();
    methods.render(automatic, request);
    const size_t before = methods.asked.size();
    request.camera.positionM.x += 1;
    methods.render(automatic, request);
    EXPECT_EQ(methods.asked.size(), before + 1);
    EXPECT_EQ(methods.asked.back().camera.positionM, request.camera.positionM);
    request.style = Style::unlit;
    methods.render(automatic, request);
    EXPECT_GT(methods.asked.size(), before + 2);
}

TEST(AutomaticMethod, RendersAsItWasAskedTo) {
    AutomaticMethod automatic;
    Methods methods;
    RenderRequest request = smallRequest();
    request.frames = 7;
    request.samples = 4;
    request.linearOutput = request.timesStages = true;
    request.anisotropy = 3;
    request.output = OutputKind::depth;
    methods.render(automatic, request);
    const RenderRequest& last = methods.asked.back();
    EXPECT_EQ(last.frames, 7);
    EXPECT_EQ(last.samples, 4);
    EXPECT_TRUE(last.linearOutput && last.timesStages);
    EXPECT_FALSE(last.measuresError);
    EXPECT_EQ(last.anisotropy, 3);
    EXPECT_EQ(last.output, OutputKind::depth);
    EXPECT_NE(last.method, Method::automatic);
}

}  // namespace
}  // namespace curvewall
