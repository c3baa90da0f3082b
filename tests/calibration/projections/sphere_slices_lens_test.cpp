#include "calibration/projections/sphere_slices_lens.h"

#include "tests/support/round_trip.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

namespace curvewall {
namespace {

using test::kPi;
constexpr glm::ivec2 kSizePx(1000, 800);
constexpr double kNever = std::numeric_limits<double>::infinity();

LensPtr lensOf(double horizontalDeg, double verticalDeg) {
    return std::make_shared<SphereSlicesLens>(horizontalDeg * kPi / 180, verticalDeg * kPi / 180, kSizePx);
}

TEST(SphereSlicesLens, EveryPixelComesBack) {
    test::Random random(1);
    for (const double horizontalDeg : {1.0, 90.0, 180.0}) {
        for (const double verticalDeg : {1.0, 180.0, 359.9, 360.0}) {
            const LensProjection projection(lensOf(horizontalDeg, verticalDeg), test::anyOrientation(random));
            const auto result = test::roundTrip(projection, kSizePx, 2, [](glm::dvec2) { return false; },
                                                {kNever, verticalDeg == 360 ? 800 : kNever});
            EXPECT_LT(result.worstPx, 1e-6) << horizontalDeg << ' ' << verticalDeg;
            EXPECT_EQ(result.wrongHoles, 0);
        }
    }
}

TEST(SphereSlicesLens, EveryRowIsAPlaneThroughTheXAxisSampledAtEqualAngles) {
    const LensPtr lens = lensOf(150, 120);
    test::Random random(3);
    for (int i = 0; i < 100'000; ++i) {
        const glm::dvec2 px = random.pixel(kSizePx);
        const double a = kPi / 2 + (px.x / 1000 - 0.5) * 150 * kPi / 180;
        const double psi = (0.5 - px.y / 800) * 120 * kPi / 180;
        const glm::dvec3 expected(-std::cos(a), std::sin(a) * std::sin(psi), -std::sin(a) * std::cos(psi));
        ASSERT_LT(glm::distance(*lens->direction(px), expected), 1e-14);
    }
}

TEST(SphereSlicesLens, LooksAheadInTheMiddleWithRightAndUpWhereTheyBelong) {
    const LensPtr lens = lensOf(180, 180);
    EXPECT_LT(glm::distance(*lens->direction({500, 400}), glm::dvec3(0, 0, -1)), 1e-15);
    EXPECT_LT(glm::distance(*lens->direction({500, 0}), glm::dvec3(0, 1, 0)), 1e-15);
    for (const double y : {0.0, 123.0, 800.0})
        EXPECT_LT(glm::distance(*lens->direction({1000, y}), glm::dvec3(1, 0, 0)), 1e-15);
    EXPECT_NEAR(lens->positions({2, 0, 0}).at(0).x, 1000, 1e-12);
    EXPECT_NEAR(lens->positions({-2, 0, 0}).at(0).x, 0, 1e-12);
    EXPECT_FALSE(lens->direction({1000.001, 400}));
    EXPECT_FALSE(lens->direction({-0.001, 400}));
}

}  // namespace
}  // namespace curvewall
