#include "calibration/projections/angle_axis.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace curvewall {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

constexpr double kTurn = 2 * std::numbers::pi;

TEST(AngleAxis, UpToATurnEveryAngleHasOnePositionInsideThePictureOrNot) {
    const AngleAxis half{kTurn / 2, 100};
    EXPECT_DOUBLE_EQ(half.angleAt(0), -kTurn / 4);
    EXPECT_THAT(half.positionsOf(kTurn / 8), ElementsAre(DoubleNear(75, 1e-12)));
    EXPECT_THAT(half.positionsOf(-kTurn / 2), ElementsAre(DoubleNear(-50, 1e-12)));
}

TEST(AngleAxis, AFullTurnWrapsIntoThePicture) {
    const AngleAxis full{kTurn, 100};
    for (const double angle : {-kTurn / 2, kTurn / 2, -kTurn / 2 - 1e-16, kTurn / 2 - 1e-16, 1e-17, 0.0}) {
        ASSERT_EQ(full.positionsOf(angle).size(), 1u);
        EXPECT_GE(full.positionsOf(angle)[0], 0);
        EXPECT_LT(full.positionsOf(angle)[0], 100);
    }
}

TEST(AngleAxis, BeyondATurnEveryRepetitionIsAnswered) {
    const AngleAxis wide{1.5 * kTurn, 150};  // 100 px a turn
    EXPECT_THAT(wide.positionsOf(0), ElementsAre(DoubleNear(75, 1e-12)));
    EXPECT_THAT(wide.positionsOf(kTurn / 2), ElementsAre(DoubleNear(25, 1e-12), DoubleNear(125, 1e-12)));
    EXPECT_THAT(wide.positionsOf(kTurn / 4), ElementsAre(DoubleNear(0, 1e-12), DoubleNear(100, 1e-12)));
    EXPECT_THAT(wide.positionsOf(-kTurn / 4), ElementsAre(DoubleNear(50, 1e-12), DoubleNear(150, 1e-12)));
    EXPECT_EQ((AngleAxis{4 * kTurn, 400}.positionsOf(0.1).size()), 4u);
    EXPECT_EQ((AngleAxis{kTurn * (1 + 1e-9), 100}.positionsOf(0.1).size()), 1u);
}

TEST(AngleAxis, WhatIsNoAngleHarmsNothing) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double turns : {0.5, 1.0, 3.0})
        for (const double px : AngleAxis{turns * kTurn, 100}.positionsOf(nan)) EXPECT_TRUE(std::isnan(px));
}

}  // namespace
}  // namespace curvewall
