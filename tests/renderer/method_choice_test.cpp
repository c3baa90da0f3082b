#include "renderer/method_choice.h"

#include "calibration/pieces/piece_fit.h"
#include "renderer/display_facts.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/lens_walls.h"
#include "tests/support/rendering.h"
#include "tests/support/test_walls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace curvewall {
namespace {

using ::testing::Contains;
using ::testing::StartsWith;

RenderRequest automaticRequest(Wall wall, const std::string& scene, double tolerancePx) {
    RenderRequest request = test::requestFor(std::move(wall), loadScene(scene));
    request.camera = request.scene->defaultCamera;
    request.method = Method::automatic;
    request.tolerancePx = tolerancePx;
    request.pieces =
        std::make_shared<const FittedPieces>(fitPieces(request.wall->displays.front(), tolerancePx));
    return request;
}

MethodChoice choiceFor(const RenderRequest& request) {
    return forecastMethods(request, request.wall->displays.front());
}

const MethodForecast* forecastOf(const MethodChoice& choice, Method method) {
    const auto found = std::ranges::find(choice.forecasts, method,
                                         [](const MethodForecast& each) { return each.request.method; });
    return found == choice.forecasts.end() ? nullptr : &*found;
}

Wall dome() { return test::lensWall({"Equidistant180", {RadialModel::equidistant}, 180}, glm::ivec2(256)); }

TEST(MethodChoice, HasTheFastestFirstAndPiecewiseAmongThem) {
    for (const Wall& wall : {test::planarWall({320, 240}, 90), test::fullCylinderWall({320, 80}), dome()}) {
        const MethodChoice choice = choiceFor(automaticRequest(wall, "city:2000", 0.5));
        EXPECT_NE(forecastOf(choice, Method::piecewise), nullptr);
        EXPECT_EQ(forecastOf(choice, Method::reference), nullptr);
        EXPECT_TRUE(std::ranges::is_sorted(choice.forecasts, {}, &MethodForecast::frameMs));
    }
}

TEST(MethodChoice, OfAFlatScreenIsItsOnePiece) {
    const MethodChoice choice =
        choiceFor(automaticRequest(test::planarWall({320, 240}, 90), "city:2000", 0.5));
    ASSERT_EQ(choice.forecasts.size(), 1u);
    EXPECT_EQ(choice.forecasts.front().request.method, Method::piecewise);
    EXPECT_THAT(choice.ruledOut, Contains(StartsWith("the others: one plain draw")));
}

TEST(MethodChoice, SaysWhyAMethodCannotDrawTheDisplay) {
    const MethodChoice choice =
        choiceFor(automaticRequest(test::fullCylinderWall({320, 80}), "city:2000", 0.5));
    EXPECT_THAT(choice.ruledOut, Contains(StartsWith("bounded-raycast, triangle: ")));
    EXPECT_THAT(choice.ruledOut, Contains(StartsWith("bounded-raycast, quad: ")));
    EXPECT_THAT(choice.ruledOut, Contains(StartsWith("image-based, planar: ")));
    EXPECT_EQ(forecastOf(choice, Method::boundedRaycast), nullptr);
}

TEST(MethodChoice, OfARoundLensCountsOnBothBoundingShapes) {
    const MethodChoice choice = choiceFor(automaticRequest(dome(), "city:2000", 0.5));
    EXPECT_EQ(std::ranges::count(choice.forecasts, Method::boundedRaycast,
                                 [](const MethodForecast& each) { return each.request.method; }),
              2);
}

TEST(MethodChoice, TurnsTheKnobsToTheTolerance) {
    const Wall wall = test::fullCylinderWall({800, 200});
    const MethodChoice coarse = choiceFor(automaticRequest(wall, "city:2000", 0.5)),
                       fine = choiceFor(automaticRequest(wall, "city:2000", 0.125));
    const auto faceSizePx = [](const MethodChoice& choice) {
        return forecastOf(choice, Method::imageBased)->request.faceSizePx;
    };
    const auto edgePx = [](const MethodChoice& choice) {
        return forecastOf(choice, Method::vertexWarp)->request.tessellationPx;
    };
    EXPECT_NEAR(faceSizePx(fine), 4.0 * faceSizePx(coarse), 4);
    EXPECT_NEAR(edgePx(fine), edgePx(coarse) / 2, 1e-3);
    const DisplayFacts facts = factsOf(wall.displays.front());
    EXPECT_LE(strokeErrorPx(facts, edgePx(fine)), 0.125);
    EXPECT_GE(strokeErrorPx(facts, edgePx(fine)), 0.125 / 4);
    EXPECT_LT(forecastOf(coarse, Method::imageBased)->frameMs, forecastOf(fine, Method::imageBased)->frameMs);
    EXPECT_LT(forecastOf(coarse, Method::vertexWarp)->frameMs, forecastOf(fine, Method::vertexWarp)->frameMs);
}

TEST(MethodChoice, RulesOutPicturesTooLargeToHold) {
    const MethodChoice choice =
        choiceFor(automaticRequest(test::fullCylinderWall({1600, 400}), "city:2000", 0.01));
    EXPECT_THAT(choice.ruledOut, Contains(StartsWith("image-based, cube: ")));
    EXPECT_EQ(forecastOf(choice, Method::imageBased), nullptr);
}

TEST(MethodChoice, LeavesShortEdgesAsTheyAre) {
    const MethodChoice choice = choiceFor(automaticRequest(test::fullCylinderWall({32, 8}), "city:2000", 50));
    ASSERT_NE(forecastOf(choice, Method::vertexWarp), nullptr);
    EXPECT_EQ(forecastOf(choice, Method::vertexWarp)->request.tessellationPx, 0);
}

TEST(MethodChoice, ExpectsMoreWorkOfMoreTriangles) {
    const Wall wall = dome();
    const MethodChoice few = choiceFor(automaticRequest(wall, "city:2000", 0.5)),
                       many = choiceFor(automaticRequest(wall, "city:50000", 0.5));
    for (const MethodForecast& forecast : few.forecasts)
        EXPECT_LT(forecast.frameMs, forecastOf(many, forecast.request.method)->frameMs)
            << settingsOf(forecast.request);
}

}  // namespace
}  // namespace curvewall
