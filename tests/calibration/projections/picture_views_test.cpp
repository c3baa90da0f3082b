#include "calibration/projections/picture_views.h"

#include "calibration/projections/frustum.h"
#include "calibration/projections/planar.h"
#include "tests/support/round_trip.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <memory>

namespace curvewall {
namespace {

constexpr glm::ivec2 kSizePx{80, 60};

ProjectionPtr viewTowards(double yawDeg) {
    const double sideRad = glm::radians(40.0);
    return std::make_shared<FrustumProjection>(
        Frustum{-sideRad, sideRad, -sideRad, sideRad, {.yawRad = glm::radians(yawDeg)}}, kSizePx);
}

TEST(MirroredProjections, ShowOnOneSideWhatThePictureShowsOnTheOther) {
    const ProjectionPtr picture = viewTowards(20);
    const MirroredProjection inX(picture, kSizePx, true, false), inBoth(picture, kSizePx, true, true);
    EXPECT_EQ(*inX.unproject({10, 5}), *picture->unproject({70, 5}));
    EXPECT_EQ(*inBoth.unproject({10, 5}), *picture->unproject({70, 55}));
    EXPECT_LT(test::roundTrip(inX, kSizePx, 1).worstPx, 1e-6);
    EXPECT_LT(test::roundTrip(inBoth, kSizePx, 2).worstPx, 1e-6);
}

TEST(CroppedProjections, HaveAHoleAroundTheirRectangle) {
    const CroppedProjection cropped(viewTowards(20), {10, 5}, {50, 60});
    const auto isHole = [](glm::dvec2 px) { return px.x < 10 || px.x > 50 || px.y < 5; };
    const test::RoundTrip trip = test::roundTrip(cropped, kSizePx, 3, isHole);
    EXPECT_EQ(trip.wrongHoles, 0);
    EXPECT_GT(trip.holes, 1000);
    EXPECT_LT(trip.worstPx, 1e-6);
}

TEST(PictureAtlases, ShowEachPictureInItsPlace) {
    const ProjectionPtr left = viewTowards(-30), right = viewTowards(40);
    const PictureAtlas atlas({left, right}, kSizePx);
    EXPECT_EQ(*atlas.unproject(atlas.placePx(0) + glm::dvec2(10, 20)), *left->unproject({10, 20}));
    EXPECT_EQ(*atlas.unproject(atlas.placePx(1) + glm::dvec2(10, 20)), *right->unproject({10, 20}));
    // A mesh that reaches beyond the border sees how the picture goes on.
    EXPECT_EQ(*atlas.unproject(atlas.placePx(1) + glm::dvec2(-9, 20)), *right->unproject({-9, 20}));
    EXPECT_FALSE(atlas.unproject({-1, 0}));
    EXPECT_FALSE(atlas.unproject({atlas.sizePx().x + 1, 0}));
}

TEST(PictureAtlases, FindARayInAllPicturesThatShowIt) {
    const PictureAtlas atlas({viewTowards(-30), viewTowards(30)}, kSizePx);
    EXPECT_EQ(atlas.project({0, 0, -1}).size(), 2U);
    EXPECT_LT(test::roundTrip(atlas, glm::ivec2(atlas.sizePx()), 4).worstPx, 1e-6);
}

TEST(PictureViews, FollowTheEye) {
    const PlanarScreen screen{{-1, -1, -2}, {1, -1, -2}, {-1, 1, -2}};
    const auto planar = std::make_shared<PlanarProjection>(screen, glm::dvec3(0), kSizePx);
    const PictureAtlas atlas({viewTowards(0), planar}, kSizePx);
    EXPECT_TRUE(atlas.dependsOnEye());
    EXPECT_FALSE(PictureAtlas({viewTowards(0)}, kSizePx).dependsOnEye());
    const auto moved = atlas.seenFrom({0.5, 0, 0});
    EXPECT_LT(glm::distance(*moved->unproject(atlas.placePx(1)), glm::dvec3(-1.5, 1, -2)), 1e-12);
    const MirroredProjection mirrored(planar, kSizePx, true, false);
    EXPECT_LT(glm::distance(*mirrored.seenFrom({0.5, 0, 0})->unproject({80, 0}), glm::dvec3(-1.5, 1, -2)),
              1e-12);
    const CroppedProjection cropped(planar, {0, 0}, {10, 10});
    EXPECT_LT(glm::distance(*cropped.seenFrom({0.5, 0, 0})->unproject({0, 0}), glm::dvec3(-1.5, 1, -2)),
              1e-12);
    EXPECT_FALSE(cropped.seenFrom({0.5, 0, 0})->unproject({11, 0}));
}

}  // namespace
}  // namespace curvewall
