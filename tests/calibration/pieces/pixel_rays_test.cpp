#include "calibration/pieces/pixel_rays.h"

#include "tests/support/test_projections.h"

#include <gtest/gtest.h>

#include <limits>

namespace curvewall {
namespace {

TEST(PixelRays, AreThoseOfThePixelsCentresKeptOrNot) {
    const PinholeProjection projection({40, 30}, 25, 3);
    PixelRays rays(projection, {40, 30});
    for (const bool kept : {false, true}) {
        if (kept) rays.keep({});
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x)
                EXPECT_EQ(rays.at({x, y}), *projection.unproject({x + 0.5, y + 0.5}));
    }
}

TEST(PixelRays, WhatIsNoDirectionIsAHole) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN(),
                     kInfinity = std::numeric_limits<double>::infinity();
    const RayListProjection projection(
        8, {std::nullopt, glm::dvec3(0), glm::dvec3(0, kNan, 1), glm::dvec3(kInfinity, 0, 0),
            glm::dvec3(1e200, 0, 0),  // its square is no number
            glm::dvec3(1e-200, 0, 0), glm::dvec3(0, 0, -1e30), glm::dvec3(1e-30, 0, 0)});
    const PixelRays rays(projection, {8, 1});
    for (int x = 0; x < 6; ++x) EXPECT_FALSE(rays.has({x, 0})) << x;
    EXPECT_TRUE(rays.has({6, 0}));
    EXPECT_TRUE(rays.has({7, 0}));
}

}  // namespace
}  // namespace curvewall
