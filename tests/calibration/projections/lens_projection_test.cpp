#include "calibration/projections/lens_projection.h"

#include "calibration/errors.h"
#include "calibration/projections/camera_lens.h"
#include "calibration/projections/radial_lens.h"
#include "calibration/readers/wall_reader.h"
#include "tests/support/round_trip.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace curvewall {
namespace {

using test::kPi;
constexpr glm::ivec2 kSizePx(800, 800);

LensPtr fisheye() { return circularLens({RadialModel::equidistant}, kPi, kSizePx); }

bool shows(const Display& display, glm::dvec3 ray, double marginPx = 0) {
    return std::ranges::any_of(display.projection->project(ray), [&](glm::dvec2 px) {
        return px.x >= marginPx && px.y >= marginPx && px.x <= display.sizePx.x - marginPx &&
               px.y <= display.sizePx.y - marginPx;
    });
}

TEST(LensProjection, TheLensTurnsWithItsPose) {
    const Orientation orientation{0.7, -0.4, 0.2};
    const LensProjection projection(fisheye(), orientation);
    const glm::dmat3 turn = rotationFromOrientation(orientation);
    test::Random random(1);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec2 px = glm::dvec2(400) + 200.0 * random.pixel({1, 1});
        const glm::dvec3 expected = turn * *fisheye()->direction(px);
        ASSERT_LT(glm::distance(*projection.unproject(px), expected), 1e-14);
        ASSERT_EQ(*projection.seenFrom({5, 6, 7})->unproject(px), *projection.unproject(px));
    }
    EXPECT_FALSE(projection.unproject({0, 0}));
}

TEST(DomeProjection, TheEyeSeesThePointThatTheLensThrowsLightOn) {
    test::Random random(2);
    for (int i = 0; i < 20'000; ++i) {
        const DomeSurface dome{random.inBox(3), random.uniform(1, 10)};
        const Pose pose{dome.centerM + 0.99 * dome.radiusM * random.uniform(0, 1) * random.direction(),
                        test::anyOrientation(random)};
        const glm::dvec3 eye = dome.centerM + 0.99 * dome.radiusM * random.uniform(0, 1) * random.direction();
        const DomeProjection projection(fisheye(), pose, dome, eye);
        const glm::dvec2 px =
            glm::dvec2(400) + 280.0 * glm::dvec2(random.uniform(-1, 1), random.uniform(-1, 1));
        const glm::dvec3 seen = *projection.unproject(px);
        ASSERT_NEAR(glm::distance(eye + seen, dome.centerM), dome.radiusM, 1e-9);
        const glm::dvec3 thrown = glm::normalize(eye + seen - pose.centerM);
        const glm::dvec3 expected = rotationFromOrientation(pose.orientation) * *fisheye()->direction(px);
        ASSERT_LT(glm::distance(thrown, expected), 1e-9);
        for (const double length : {1.0, 1e-6, 1e6})
            ASSERT_LT(glm::distance(projection.project(length * seen).at(0), px), 1e-6);
    }
}

TEST(DomeProjection, EveryPixelComesBack) {
    const DomeSurface dome{{0.5, 0, -1}, 6};
    const auto inCircle = [](glm::dvec2 px) { return glm::distance(px, glm::dvec2(400)) > 400; };
    const DomeProjection offCentre(fisheye(), {{0.5, 1, -1}, {0.3, kPi / 2, 0}}, dome, {2, -0.5, 1});
    EXPECT_LT(test::roundTrip(offCentre, kSizePx, 3, inCircle).worstPx, 1e-6);
    EXPECT_EQ(test::roundTrip(offCentre, kSizePx, 3, inCircle).wrongHoles, 0);

    const auto camera = std::make_shared<PinholeLens>(
        CameraIntrinsics{{700, 705}, {402.1, 398.3}, {-0.1, 0.02, 0.001, 0.0005}});
    const DomeProjection projector(camera, {{0.5, -0.5, 4.5}, {0, 0.4, 0}}, dome, {2, -0.5, 1});
    EXPECT_LT(test::roundTrip(projector, kSizePx, 4).worstPx, 1e-6);
}

TEST(DomeProjection, FromTheLensItselfItLooksLikeTheLens) {
    const Pose pose{{0.5, 1, -1}, {0.1, 0.2, 0.3}};
    const DomeProjection projection(fisheye(), pose, {{0, 0, 0}, 5}, {1, 1, 1});
    const LensProjection atInfinity(fisheye(), pose.orientation);
    const auto there = projection.seenFrom(pose.centerM);
    for (const glm::dvec2 px : {glm::dvec2(400, 400), glm::dvec2(12, 390), glm::dvec2(600, 600)})
        EXPECT_LT(glm::distance(glm::normalize(*there->unproject(px)), *atInfinity.unproject(px)), 1e-12);
}

TEST(DomeProjection, LensesAndEyesOutsideAreRefused) {
    const DomeSurface dome{{0, 0, 0}, 4};
    EXPECT_THROW(DomeProjection(fisheye(), {{4, 0, 0}, {}}, dome, {0, 0, 0}), UsageError);
    EXPECT_THROW(DomeProjection(fisheye(), {}, dome, {3, 3, 0}), UsageError);
    const DomeProjection inside(fisheye(), {{3.99, 0, 0}, {}}, dome, {0, -3.99, 0});
    EXPECT_THROW(inside.seenFrom({0, 4.01, 0}), UsageError);
}

TEST(ShippedWalls, TheDomeMasterHasItsFrontAtTheBottomAndItsRightAtTheRight) {
    const Wall wall = readWall(CURVEWALL_SOURCE_DIR "/configs/dome-master.json");
    const Projection& dome = *wall.displays.at(0).projection;
    EXPECT_LT(glm::distance(*dome.unproject({1024, 1024}), glm::dvec3(0, 1, 0)), 1e-12);
    EXPECT_LT(glm::distance(*dome.unproject({1024, 2048}), glm::dvec3(0, 0, -1)), 1e-12);
    EXPECT_LT(glm::distance(*dome.unproject({2048, 1024}), glm::dvec3(1, 0, 0)), 1e-12);
}

TEST(ShippedWalls, FiveProjectorsCoverTheDomeFromTenDegreesUp) {
    const Wall wall = readWall(CURVEWALL_SOURCE_DIR "/configs/five-projector-dome.json");
    ASSERT_EQ(wall.displays.size(), 5u);
    test::Random random(5);
    int seen = 0, seenTwice = 0;
    std::vector<int> sharedWithNext(4, 0);
    while (seen < 20'000) {
        const glm::dvec3 ray = random.direction();
        if (ray.y < std::sin(10 * kPi / 180)) continue;
        ++seen;
        // 16 px of margin: the cover does not hang by a thread.
        const auto count =
            std::ranges::count_if(wall.displays, [&](const Display& d) { return shows(d, ray, 16); });
        ASSERT_GE(count, 1) << ray.x << ' ' << ray.y << ' ' << ray.z;
        seenTwice += count > 1;
        for (size_t i = 0; i < 4; ++i)
            sharedWithNext[i] += shows(wall.displays[i], ray) && shows(wall.displays[(i + 1) % 4], ray);
    }
    EXPECT_GT(seenTwice, 0.6 * seen);
    for (const int shared : sharedWithNext) EXPECT_GT(shared, 0.05 * seen);
    for (const Display& display : wall.displays)
        EXPECT_EQ(test::roundTrip(*display.projection, display.sizePx, 6).holes, 0);
}

}  // namespace
}  // namespace curvewall
