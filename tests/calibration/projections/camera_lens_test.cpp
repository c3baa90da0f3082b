#include "calibration/projections/camera_lens.h"

#include "tests/support/round_trip.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

namespace curvewall {
namespace {

using test::kPi;
constexpr glm::ivec2 kSizePx(1920, 1080);

CameraIntrinsics intrinsicsOf(std::vector<double> distortion) {
    return {{1180.4, 1195.9}, {962.3, 541.8}, std::move(distortion)};
}

// Believable ones of every length.
const std::vector<std::vector<double>> kPinholes{
    {},
    {-0.21, 0.06, 0.0012, -0.0023},
    {-0.28, 0.09, 0.0008, -0.0005, -0.012},
    {0.35, 0.08, -0.001, 0.0007, 0.003, 0.62, 0.11, 0.005},
    {-0.2, 0.05, 0.001, 0.002, -0.004, 0.02, 0.01, 0.001, 0.003, -0.002, 0.0015, 0.001},
    {-0.2, 0.05, 0.001, 0.002, -0.004, 0.02, 0.01, 0.001, 0.003, -0.002, 0.0015, 0.001, 0.04, -0.07},
};
const std::vector<std::vector<double>> kFisheyes{{}, {0.021, -0.0063, 0.0012, -0.0002}, {-0.09, 0.01, 0, 0}};

glm::dvec3 flipped(glm::dvec3 v) { return {v.x, -v.y, -v.z}; }  // between OpenCV's axes and ours

// Where OpenCV sees the ray, in our pixels.
glm::dvec2 byOpenCv(const CameraIntrinsics& c, bool isFisheye, glm::dvec3 ray) {
    const glm::dvec3 p = flipped(ray);
    const std::vector<cv::Point3d> points{{p.x, p.y, p.z}};
    std::vector<cv::Point2d> pixels;
    const cv::Matx33d camera(c.focalPx.x, 0, c.principalPx.x, 0, c.focalPx.y, c.principalPx.y, 0, 0, 1);
    const cv::Vec3d none(0, 0, 0);
    if (isFisheye) {
        std::vector<double> k = c.distortion;
        k.resize(4, 0.0);
        cv::fisheye::projectPoints(points, pixels, none, none, camera, k);
    } else {
        cv::projectPoints(points, none, none, camera, c.distortion, pixels);
    }
    return {pixels[0].x + 0.5, pixels[0].y + 0.5};
}

TEST(PinholeLens, AgreesWithOpenCvBothWaysForEveryNumberOfCoefficients) {
    test::Random random(1);
    for (const auto& distortion : kPinholes) {
        const CameraIntrinsics camera = intrinsicsOf(distortion);
        const PinholeLens lens(camera);
        for (int i = 0; i < 5000; ++i) {
            const glm::dvec3 ray = random.uniform(0.1, 10) *
                                   glm::dvec3(random.uniform(-0.8, 0.8), random.uniform(-0.5, 0.5), -1);
            const glm::dvec2 px = byOpenCv(camera, false, ray);
            ASSERT_LT(glm::distance(lens.positions(ray).at(0), px), 1e-9) << distortion.size();
            ASSERT_LT(glm::distance(lens.direction(px).value(), glm::normalize(ray)), 1e-9);
            const glm::dvec2 anyPx = random.pixel(kSizePx);
            ASSERT_LT(glm::distance(byOpenCv(camera, false, lens.direction(anyPx).value()), anyPx), 1e-6);
        }
    }
}

TEST(FisheyeCameraLens, AgreesWithOpenCvBothWays) {
    test::Random random(2);
    for (const auto& distortion : kFisheyes) {
        CameraIntrinsics camera = intrinsicsOf(distortion);
        camera.focalPx = {700, 705};
        const LensPtr lens = fisheyeCameraLens(camera);
        for (int i = 0; i < 5000; ++i) {
            const double t = random.uniform(0, 1.5), phi = random.uniform(-kPi, kPi);
            const glm::dvec3 ray(std::sin(t) * std::cos(phi), std::sin(t) * std::sin(phi), -std::cos(t));
            const glm::dvec2 px = byOpenCv(camera, true, ray);
            ASSERT_LT(glm::distance(lens->positions(3.0 * ray).at(0), px), 1e-9);
            ASSERT_LT(glm::distance(lens->direction(px).value(), ray), 1e-12);
        }
    }
}

TEST(CameraLens, EveryPixelComesBack) {
    test::Random random(3);
    for (const auto& distortion : kPinholes) {
        const LensProjection projection(std::make_shared<PinholeLens>(intrinsicsOf(distortion)),
                                        test::anyOrientation(random));
        const auto result = test::roundTrip(projection, kSizePx, 4);
        EXPECT_LT(result.worstPx, 1e-6) << distortion.size();
        EXPECT_EQ(result.holes, 0) << distortion.size();
    }
    for (const auto& distortion : kFisheyes) {
        const LensProjection projection(fisheyeCameraLens(intrinsicsOf(distortion)),
                                        test::anyOrientation(random));
        const auto result = test::roundTrip(projection, kSizePx, 5);
        EXPECT_LT(result.worstPx, 1e-6) << distortion.size();
        EXPECT_EQ(result.holes, 0);
    }
}

TEST(PinholeLens, BarrelsAreUsedUpToTheirTurningPoint) {
    // r - r^3 / 2 turns at r = sqrt(2/3) and reaches (2/3)^1.5 there.
    CameraIntrinsics camera{{700, 700}, {639.5, 399.5}, {-0.5, 0, 0, 0}};
    const auto lens = std::make_shared<PinholeLens>(camera);
    const double turn = std::sqrt(2.0 / 3), circlePx = 700 * std::pow(2.0 / 3, 1.5);
    EXPECT_NEAR(lens->mostRadius(), turn, 1e-12);
    const auto isHole = [&](glm::dvec2 px) { return glm::distance(px, {640, 400}) > circlePx; };
    const auto result = test::roundTrip(LensProjection(lens, {0.3, 0.2, 0.1}), {1280, 800}, 6, isHole);
    EXPECT_LT(result.worstPx, 1e-6);
    EXPECT_EQ(result.wrongHoles, 0);
    EXPECT_NEAR(result.holes, 100'000 * (1 - kPi * circlePx * circlePx / (1280 * 800)), 800);

    test::Random random(7);
    for (int i = 0; i < 10'000; ++i) {
        const glm::dvec2 px = random.pixel({1280, 800});
        if (const auto d = lens->direction(px)) {
            // The root in the middle of the cubic's three.
            const double q = glm::distance(px, {640, 400}) / 700;
            const double r = 2 * turn * std::sin(std::asin(q / std::pow(2.0 / 3, 1.5)) / 3);
            ASSERT_NEAR(glm::length(glm::dvec2(*d)) / -d->z, r, 1e-6);
        }
    }
    EXPECT_TRUE(lens->positions({0.82, 0, -1}).empty());  // OpenCV would put it on an inner pixel's place
    EXPECT_EQ(lens->positions({0.81, 0, -1}).size(), 1u);
    EXPECT_TRUE(lens->positions({0, 0, 1}).empty());
    EXPECT_TRUE(lens->positions({0, 1, 0}).empty());
}

TEST(PinholeLens, StopsAtThePoleOfARationalDistortion) {
    const PinholeLens lens({{700, 700}, {639.5, 399.5}, {0, 0, 0, 0, 0, -0.3, 0, 0}});
    EXPECT_NEAR(lens.mostRadius(), std::sqrt(1 / 0.3), 1e-9);
    test::Random random(8);
    for (int i = 0; i < 10'000; ++i) {
        const auto d = lens.direction(random.pixel({4000, 4000}));
        ASSERT_TRUE(d);
        ASSERT_LT(glm::length(glm::dvec2(*d)) / -d->z, lens.mostRadius());
    }
}

TEST(PinholeLens, DistortionsThatCancelLeaveThePlainCamera) {
    const PinholeLens lens({{700, 700}, {639.5, 399.5}, {-0.5, 0, 0, 0, 0, -0.5, 0, 0}});
    EXPECT_LT(glm::distance(lens.direction({710, 330}).value(), glm::normalize(glm::dvec3(0.1, 0.1, -1))),
              1e-12);
}

// Far stronger than lenses are: within the disc there is one answer and it is found; beyond it none is given.
TEST(PinholeLens, NoDistortionHoweverStrongGivesAWrongRay) {
    test::Random random(9);
    int turning = 0;
    for (int variant = 0; variant < 300; ++variant) {
        std::vector<double> k(14);
        const auto any = [&](double size) { return random.uniform(-size, size); };
        k = {any(0.6),  any(0.3),  any(0.03), any(0.03), any(0.1),  any(0.3), any(0.1),
             any(0.05), any(0.03), any(0.01), any(0.03), any(0.01), any(0.3), any(0.3)};
        if (variant % 3 == 0) std::fill(k.begin() + 5, k.end(), 0.0);
        const CameraIntrinsics camera = intrinsicsOf(k);
        const PinholeLens lens(camera);
        turning += lens.mostRadius() < 3;
        const double most = std::min(3.0, 0.9999 * lens.mostRadius());
        for (int i = 0; i < 300; ++i) {
            const double r = most * std::sqrt(random.uniform(0, 1)), phi = random.uniform(-kPi, kPi);
            const glm::dvec3 ray(r * std::cos(phi), r * std::sin(phi), -1);
            const auto positions = lens.positions(ray);
            if (positions.empty()) continue;  // behind the tilted sensor
            const auto back = lens.direction(positions[0]);
            ASSERT_TRUE(back) << variant << ": radius " << r << " of " << lens.mostRadius();
            ASSERT_LT(glm::distance(glm::dvec2(*back) / -back->z, glm::dvec2(ray)), 1e-5 * (1 + r * r))
                << variant << ": radius " << r << " of " << lens.mostRadius();
        }
        for (int i = 0; i < 300; ++i) {
            const glm::dvec2 px = random.pixel({6000, 4000}) - glm::dvec2(2000, 1500);
            const auto ray = lens.direction(px);
            if (!ray) continue;
            ASSERT_LT(glm::distance(byOpenCv(camera, false, *ray), px), 1e-6);
            ASSERT_LT(glm::length(glm::dvec2(*ray)) / -ray->z, lens.mostRadius());
        }
    }
    EXPECT_GT(turning, 50);
}

TEST(FisheyeCameraLens, IsUsedUpToItsTurningPoint) {
    // t (1 - t^2 / 12) turns at t = 2.
    const LensPtr lens = fisheyeCameraLens({{300, 300}, {499.5, 499.5}, {-1.0 / 12, 0, 0, 0}});
    const auto at = [](double t) { return glm::dvec3(std::sin(t), 0, -std::cos(t)); };
    EXPECT_EQ(lens->positions(at(1.999)).size(), 1u);
    EXPECT_TRUE(lens->positions(at(2.001)).empty());
    EXPECT_TRUE(lens->direction({500 + 300 * 4.0 / 3 - 0.001, 500}));
    EXPECT_FALSE(lens->direction({500 + 300 * 4.0 / 3 + 0.001, 500}));
}

}  // namespace
}  // namespace curvewall
