#include "report/errors.h"

#include "calibration/errors.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/rendering.h"
#include "tests/support/shipped_walls.h"
#include "tests/support/small_walls.h"
#include "tests/support/test_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace curvewall {
namespace {

constexpr glm::ivec2 kSizePx{40, 30};

Frame constantFrame(int channels, float value) {
    return {kSizePx, channels,
            std::vector<float>(static_cast<size_t>(kSizePx.x * kSizePx.y * channels), value)};
}

float& texel(Frame& frame, int x, int y) {
    return frame.texels[static_cast<size_t>((y * frame.sizePx.x + x) * frame.channels)];
}

class ErrorsOf : public ::testing::Test {
protected:
    ErrorsOf() : wall_(test::smallShippedWall("planar-90", 1)) {
        wall_.displays[0].sizePx = kSizePx;
        truth_.color = drawn_.color = constantFrame(3, 0.5f);
        drawn_.position = constantFrame(3, 0);
        for (int y = 0; y < kSizePx.y; ++y)
            for (int x = 0; x < kSizePx.x; ++x) {
                const auto ray = wall_.displays[0].projection->unproject({x + 0.5, y + 0.5}).value();
                for (int axis = 0; axis < 3; ++axis)
                    (&texel(drawn_.position, x, y))[axis] = static_cast<float>(ray[axis]);
            }
        truth_.position = drawn_.position;
        truth_.coverage = drawn_.coverage = constantFrame(1, 2);
    }
    MethodErrors errors() const { return errorsOf(drawn_, truth_, wall_.displays[0]); }

    Wall wall_;
    Truth truth_;
    DrawnOutputs drawn_;
};

TEST_F(ErrorsOf, EqualPicturesAreNone) {
    const MethodErrors none = errors();
    EXPECT_EQ(none.coverage.total(), 0u);
    EXPECT_EQ(none.image.shareOff, 0);
    EXPECT_EQ(none.nanTexels, 0u);
    EXPECT_EQ(none.misplacedPixels, 0u);
}

TEST_F(ErrorsOf, ACrackIsAPixelUncovered) {
    texel(drawn_.coverage, 7, 9) = 0;
    EXPECT_EQ(errors().coverage.uncoveredPixels, 1u);
    EXPECT_EQ(errors().coverage.total(), 1u);
}

TEST_F(ErrorsOf, AnEdgeThatLiesAPixelAsideIsNoErrorOfCoverage) {
    for (int y = 0; y < kSizePx.y; ++y)
        for (int x = 0; x < kSizePx.x; ++x) {
            texel(truth_.coverage, x, y) = x < 20 ? 2 : 0;
            texel(drawn_.coverage, x, y) = x < 21 ? 2 : 0;
        }
    EXPECT_EQ(errors().coverage.total(), 0u);
    for (int y = 0; y < kSizePx.y; ++y) texel(drawn_.coverage, 21, y) = 1;
    EXPECT_EQ(errors().coverage.overdrawnPixels, static_cast<uint64_t>(kSizePx.y));
}

TEST_F(ErrorsOf, MoreSurfacesThanTheTruthHasAnywhereNearCountAsTwiceCovered) {
    texel(truth_.coverage, 5, 5) = 3;
    texel(drawn_.coverage, 6, 6) = 3;
    EXPECT_EQ(errors().coverage.total(), 0u);
    texel(drawn_.coverage, 7, 7) = 3;
    EXPECT_EQ(errors().coverage.twiceCoveredPixels, 1u);
}

TEST_F(ErrorsOf, PointsThatTheDisplayDoesNotSeeAreCountedApart) {
    for (int axis = 0; axis < 3; ++axis) {
        (&texel(drawn_.position, 3, 4))[axis] *= 5;                         // on its ray all the same
        (&texel(drawn_.position, 30, 20))[axis] = axis == 2 ? 1.0f : 0.0f;  // straight behind
    }
    const MethodErrors found = errors();
    EXPECT_EQ(found.misplacedPixels, 1u);
    EXPECT_EQ(found.geometric.holes, 0);
    EXPECT_LT(found.geometric.maxPx, 1e-3);
}

TEST_F(ErrorsOf, PixelsWithANumberThatIsNoneAreCounted) {
    texel(drawn_.color, 1, 1) = (&texel(drawn_.color, 1, 1))[2] = std::nanf("");
    EXPECT_EQ(errors().nanTexels, 1u);
    texel(drawn_.color, 2, 1) = HUGE_VALF;
    EXPECT_EQ(errors().nanTexels, 2u);
}

TEST_F(ErrorsOf, APositionThatIsNoneIsCountedWhereSomethingIsShown) {
    for (const int x : {1, 2, 3})
        for (int axis = 0; axis < 3; ++axis) (&texel(drawn_.position, x, 1))[axis] = std::nanf("");
    texel(drawn_.coverage, 2, 1) = texel(drawn_.coverage, 3, 1) = 0;
    EXPECT_EQ(errors().nanTexels, 1u);
    (&texel(drawn_.position, 2, 1))[0] = 1;  // and two numbers that are none
    EXPECT_EQ(errors().nanTexels, 2u);
    (&texel(drawn_.position, 4, 1))[1] = HUGE_VALF;
    EXPECT_EQ(errors().nanTexels, 3u);
    (&texel(drawn_.position, 4, 1))[2] = texel(drawn_.color, 4, 1) = std::nanf("");
    EXPECT_EQ(errors().nanTexels, 3u);
}

TEST_F(ErrorsOf, WhatBlendsHasNoPositionInTheTruthEither) {
    for (int y = 0; y < kSizePx.y; ++y)
        for (int x = 0; x < kSizePx.x; ++x)
            for (int axis = 0; axis < 3; ++axis) {
                if (x < 20) (&texel(truth_.position, x, y))[axis] = std::nanf("");
                if (x < 21) (&texel(drawn_.position, x, y))[axis] = std::nanf("");
            }
    EXPECT_EQ(errors().nanTexels, 0u);
    for (int axis = 0; axis < 3; ++axis) (&texel(drawn_.position, 21, 7))[axis] = std::nanf("");
    EXPECT_EQ(errors().nanTexels, 1u);
}

TEST_F(ErrorsOf, CoverageLooksAcrossTheSeamOfAClosedDisplay) {
    wall_ = test::smallShippedWall("full-cylinder", 40);
    ASSERT_EQ(wall_.displays[0].sizePx, kSizePx);
    for (int y = 0; y < kSizePx.y; ++y) {
        texel(truth_.coverage, 0, y) = 0;
        texel(drawn_.coverage, kSizePx.x - 1, y) = 0;
    }
    EXPECT_EQ(errors().coverage.total(), 0u);
}

class DrawnErrors : public test::GlTest {};

TEST_F(DrawnErrors, OfPiecewiseKeepItsCertificate) {
    RenderRequest request =
        test::requestFor(test::smallShippedWall("dome-master", 8), boxRoom({8, 5, 8}), {{0.5, 0.3, 1}, {}});
    request.style = Style::unlit;
    Renderer renderer;
    const DrawnOutputs drawn = drawOutputs(renderer, request);
    RenderRequest exact = request;
    exact.method = Method::reference;
    const DrawnOutputs traced = drawOutputs(renderer, exact);
    const MethodErrors errors =
        errorsOf(drawn, {traced.color, traced.position, traced.coverage, {}}, request.wall->displays[0]);
    const double certifiedPx = drawn.stats.geometricError.maxPx;
    EXPECT_LE(errors.geometric.maxPx, certifiedPx + 1e-3);
    EXPECT_GE(errors.geometric.maxPx, 0.9 * certifiedPx);
    EXPECT_EQ(errors.coverage.total(), 0u);
    EXPECT_EQ(errors.misplacedPixels, 0u);
    EXPECT_LT(errors.image.shareOff, 0.01);
}

}  // namespace
}  // namespace curvewall
