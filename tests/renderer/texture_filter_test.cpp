#include "renderer/texture_filter.h"

#include "tests/support/test_scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace curvewall {
namespace {

// Red tells the column, green the row, as linear light: 0 or 1 alone survive sRGB unchanged.
Texture quadrants(Wrap wrap) {
    Texture texture;
    texture.wrapS = texture.wrapT = wrap;
    texture.levels = {{{2, 2}, {{0, 0, 0, 255}, {255, 0, 0, 255}, {0, 255, 0, 255}, {255, 255, 0, 0}}},
                      {{1, 1}, {{188, 188, 0, 191}}}};
    return texture;
}

TEST(SampleTexture, TexelCentresGiveTheTexel) {
    const Texture texture = quadrants(Wrap::repeat);
    EXPECT_EQ(sampleTexture(texture, {0.25, 0.25}, 0), glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(sampleTexture(texture, {0.75, 0.25}, 0), glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(sampleTexture(texture, {0.25, 0.75}, 0), glm::vec4(0, 1, 0, 1));
    EXPECT_EQ(sampleTexture(texture, {0.75, 0.75}, -3), glm::vec4(1, 1, 0, 0));
}

TEST(SampleTexture, BlendsInLinearLight) {
    const glm::vec4 middle = sampleTexture(quadrants(Wrap::clampToEdge), {0.5, 0.5}, 0);
    EXPECT_FLOAT_EQ(middle.r, 0.5f);
    EXPECT_FLOAT_EQ(middle.g, 0.5f);
    EXPECT_FLOAT_EQ(middle.a, 0.75f);
    EXPECT_FLOAT_EQ(sampleTexture(quadrants(Wrap::clampToEdge), {0.375, 0.25}, 0).r, 0.25f);
}

TEST(SampleTexture, WrapsAsTheSamplerSays) {
    // Half a texel beyond the right edge: the first column again, the last one, or the last one mirrored.
    EXPECT_FLOAT_EQ(sampleTexture(quadrants(Wrap::repeat), {1.25, 0.25}, 0).r, 0);
    EXPECT_FLOAT_EQ(sampleTexture(quadrants(Wrap::clampToEdge), {1.25, 0.25}, 0).r, 1);
    EXPECT_FLOAT_EQ(sampleTexture(quadrants(Wrap::mirroredRepeat), {1.25, 0.25}, 0).r, 1);
    EXPECT_FLOAT_EQ(sampleTexture(quadrants(Wrap::mirroredRepeat), {1.75, 0.25}, 0).r, 0);
    EXPECT_FLOAT_EQ(sampleTexture(quadrants(Wrap::mirroredRepeat), {-0.25, 0.25}, 0).r, 0);
    EXPECT_FLOAT_EQ(sampleTexture(quadrants(Wrap::mirroredRepeat), {2.25, 0.25}, 0).r, 0);
    EXPECT_FLOAT_EQ(sampleTexture(quadrants(Wrap::repeat), {-0.25, 0.25}, 0).r, 1);
    // On the seam itself.
    EXPECT_FLOAT_EQ(sampleTexture(quadrants(Wrap::repeat), {1, 0.25}, 0).r, 0.5f);
    EXPECT_FLOAT_EQ(sampleTexture(quadrants(Wrap::clampToEdge), {1, 0.25}, 0).r, 1);
    EXPECT_FLOAT_EQ(sampleTexture(quadrants(Wrap::mirroredRepeat), {1, 0.25}, 0).r, 1);
}

TEST(SampleTexture, WrappedCoordinatesSeeTheSameTexels) {
    const Texture repeat = quadrants(Wrap::repeat), mirrored = quadrants(Wrap::mirroredRepeat);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec2 uv(unit(random), unit(random));
        const glm::dvec2 turns(std::floor(200 * unit(random)) - 100, std::floor(200 * unit(random)) - 100);
        const auto near = [](glm::vec4 a, glm::vec4 b) { return glm::length(a - b) < 1e-5f; };
        EXPECT_TRUE(near(sampleTexture(repeat, uv, 0), sampleTexture(repeat, uv + turns, 0)));
        EXPECT_TRUE(near(sampleTexture(mirrored, uv, 0), sampleTexture(mirrored, uv + 2.0 * turns, 0)));
        EXPECT_TRUE(near(sampleTexture(mirrored, uv, 0), sampleTexture(mirrored, -uv, 0)));
    }
}

TEST(SampleTexture, BlendsBetweenLevels) {
    const Texture texture = levelsTexture(4, {0, 255, 0});
    EXPECT_FLOAT_EQ(sampleTexture(texture, {0.3, 0.6}, 0.25).r, 0.25f);
    EXPECT_FLOAT_EQ(sampleTexture(texture, {0.3, 0.6}, 1).r, 1);
    EXPECT_FLOAT_EQ(sampleTexture(texture, {0.3, 0.6}, 1.75).r, 0.25f);
}

TEST(SampleTexture, AnyNumberIsAnswered) {
    const double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Texture texture = levelsTexture(4, {0, 0, 255});
    EXPECT_EQ(sampleTexture(texture, {0, 0}, infinity).r, 1);
    EXPECT_EQ(sampleTexture(texture, {0, 0}, 77).r, 1);
    EXPECT_EQ(sampleTexture(texture, {0, 0}, -infinity).r, 0);
    EXPECT_EQ(sampleTexture(texture, {0, 0}, nan).r, 0);
    for (const Wrap wrap : {Wrap::repeat, Wrap::clampToEdge, Wrap::mirroredRepeat})
        for (const double u :
             {infinity, -infinity, nan, 1e300, -1e300, 1e18, std::nextafter(1.0, 0.0), -1e-300}) {
            const glm::vec4 color = sampleTexture(quadrants(wrap), {u, u}, 0.5);
            EXPECT_GE(color.r, 0) << u;
            EXPECT_LE(color.r, 1) << u;
        }
}

TEST(LevelOfDetail, IsTheLogarithmOfTheLongerSide) {
    EXPECT_DOUBLE_EQ(levelOfDetail({256, 256}, {1.0 / 256, 0}, {0, 1.0 / 256}), 0);
    EXPECT_DOUBLE_EQ(levelOfDetail({256, 128}, {8.0 / 256, 0}, {0, 2.0 / 128}), 3);
    EXPECT_DOUBLE_EQ(levelOfDetail({256, 128}, {1.0 / 256, 0}, {0, 16.0 / 128}), 4);
    // 3 texels along u and 4 along v: 5 along the side.
    EXPECT_DOUBLE_EQ(levelOfDetail({100, 200}, {3.0 / 100, 4.0 / 200}, {0, 0}), std::log2(5.0));
}

}  // namespace
}  // namespace curvewall
