#include "calibration/projections/equirectangular_lens.h"

#include "tests/support/round_trip.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace curvewall {
namespace {

using test::kPi;
constexpr glm::ivec2 kSizePx(1600, 700);
constexpr double kNever = std::numeric_limits<double>::infinity();

LensPtr lensOf(double horizontalDeg, double verticalDeg) {
    return std::make_shared<EquirectangularLens>(horizontalDeg * kPi / 180, verticalDeg * kPi / 180, kSizePx);
}

TEST(EquirectangularLens, EveryPixelComesBack) {
    test::Random random(1);
    for (const double horizontalDeg : {0.5, 90.0, 359.9, 360.0, 360.1, 540.0, 1440.0}) {
        for (const double verticalDeg : {1.0, 90.0, 180.0}) {
            const LensProjection projection(lensOf(horizontalDeg, verticalDeg), test::anyOrientation(random));
            const double turnPx = horizontalDeg >= 359 ? 1600 * 360 / horizontalDeg : kNever;
            const auto result =
                test::roundTrip(projection, kSizePx, 2, [](glm::dvec2) { return false; }, {turnPx, kNever});
            EXPECT_LT(result.worstPx, 1e-6) << horizontalDeg << ' ' << verticalDeg;
            EXPECT_EQ(result.wrongHoles, 0);
        }
    }
}

TEST(EquirectangularLens, AnglesAreLinearInPixels) {
    const LensPtr lens = lensOf(200, 100);
    test::Random random(3);
    for (int i = 0; i < 100'000; ++i) {
        const glm::dvec2 px = random.pixel(kSizePx);
        const glm::dvec3 d = *lens->direction(px);
        EXPECT_NEAR(std::atan2(d.x, -d.z) * 180 / kPi, (px.x - 800) / 8, 1e-10);
        EXPECT_NEAR(std::asin(d.y) * 180 / kPi, (350 - px.y) / 7, 1e-10);
        EXPECT_NEAR(glm::length(d), 1, 1e-14);
    }
}

TEST(EquirectangularLens, EveryColumnThatSeesARayIsAnswered) {
    const LensPtr lens = lensOf(540, 90);
    test::Random random(4);
    for (int i = 0; i < 10'000; ++i) {
        const glm::dvec2 px = random.pixel(kSizePx);
        const auto positions = lens->positions(*lens->direction(px));
        const double turnPx = 1600.0 * 360 / 540;
        for (const double other : {px.x - turnPx, px.x, px.x + turnPx}) {
            const bool answered = std::ranges::any_of(positions, [&](glm::dvec2 p) {
                return glm::distance(p, {other, px.y}) < 1e-6;
            });
            ASSERT_EQ(answered, other >= 0 && other <= 1600) << px.x << ' ' << other;
        }
    }
}

TEST(EquirectangularLens, ThePolesAreTheFirstAndTheLastRow) {
    const LensPtr lens = lensOf(360, 180);
    for (const double x : {0.0, 1.0, 799.0, 1599.9}) {
        EXPECT_LT(glm::distance(*lens->direction({x, 0}), glm::dvec3(0, 1, 0)), 1e-15);
        EXPECT_LT(glm::distance(*lens->direction({x, 700}), glm::dvec3(0, -1, 0)), 1e-15);
    }
    ASSERT_EQ(lens->positions({0, 3, 0}).size(), 1u);
    EXPECT_NEAR(lens->positions({0, 3, 0})[0].y, 0, 1e-12);
    EXPECT_NEAR(lens->positions({0, -3, 0})[0].y, 700, 1e-12);
    EXPECT_FALSE(lens->direction({10, -0.001}));
    EXPECT_FALSE(lens->direction({10, 700.001}));
}

TEST(EquirectangularLens, AFullTurnWrapsIntoThePicture) {
    const LensPtr lens = lensOf(360, 180);
    for (const double x : {-1e-17, 0.0, 1e-17, -1e-9, 1e-9}) {
        const auto positions = lens->positions({x, 0, 1});
        ASSERT_EQ(positions.size(), 1u);
        EXPECT_GE(positions[0].x, 0);
        EXPECT_LT(positions[0].x, 1600);
    }
}

}  // namespace
}  // namespace curvewall
