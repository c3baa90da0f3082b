#include "renderer/reference.h"
#include "renderer/shading.h"
#include "renderer/strokes.h"
#include "tests/support/random_numbers.h"
#include "tests/support/test_projections.h"
#include "tests/support/test_scenes.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace curvewall {
namespace {

using Options = ReferenceRenderer::Options;
using test::kPi;

constexpr Options kColor{Style::unlit, OutputKind::color};
constexpr Options kDepth{Style::unlit, OutputKind::depth};
constexpr Options kPosition{Style::unlit, OutputKind::position};
constexpr Options kCoverage{Style::unlit, OutputKind::coverage};
constexpr double kInfinity = std::numeric_limits<double>::infinity();

const Material kWhite = plainMaterial(glm::vec3(1));

Frame render(const Scene& scene, const Wall& wall, const Options& options, const Camera& camera = {}) {
    return ReferenceRenderer(std::make_shared<const Scene>(scene))
        .render(wall, wall.displays.front(), camera, options);
}

glm::vec3 rgb(const Frame& frame, int x, int y) {
    const float* texel = frame.at(x, y);
    return {texel[0], texel[1], texel[2]};
}

glm::vec3 near(test::Random& random) {
    return {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
}

double distanceToSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
    const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
    return glm::distance(p, a + t * (b - a));
}

// How many pixels show a stroke, after a check that they are those whose centre is within half of `widthPx`
// of it; a hundredth of a pixel is left open.
int expectShownWithin(const Frame& depth, double widthPx,
                      const std::function<double(glm::dvec2)>& distancePx) {
    int shown = 0, wrong = 0;
    for (int y = 0; y < depth.sizePx.y; ++y)
        for (int x = 0; x < depth.sizePx.x; ++x) {
            const bool isShown = std::isfinite(*depth.at(x, y));
            const double off = distancePx({x + 0.5, y + 0.5}) - widthPx / 2;
            shown += isShown;
            wrong += std::abs(off) > 0.01 && isShown != (off < 0);
        }
    EXPECT_EQ(wrong, 0);
    return shown;
}

constexpr glm::ivec2 kSizePx(96, 64);
constexpr double kFocalPx = 40;

glm::dvec2 pinholePx(glm::dvec3 p) {
    return glm::dvec2(kSizePx) / 2.0 + kFocalPx * glm::dvec2(p.x, -p.y) / -p.z;
}

TEST(ReferenceStrokes, PointsAreDiscs) {
    test::Random random(1);
    const Wall wall = pinholeWall(kSizePx, kFocalPx);
    int shown = 0;
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 p = near(random);
        Scene scene;
        addPoints(scene, kWhite, {p});
        shown += expectShownWithin(render(scene, wall, kDepth), kPointSizePx, [&](glm::dvec2 px) {
            return p.z < 0 ? glm::distance(px, pinholePx(p)) : kInfinity;
        });
    }
    EXPECT_GT(shown, 150) << "most see none, the others about seven pixels";
}

TEST(ReferenceStrokes, LinesAreStraightOnAFlatDisplay) {
    test::Random random(2);
    const Wall wall = pinholeWall(kSizePx, kFocalPx);
    int shown = 0;
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 a = near(random), b = near(random);
        Scene scene;
        addLines(scene, kWhite, {{a, b}});
        // What is behind the eye or beside it is cut off, far outside of the display.
        glm::dvec3 from(a), to(b);
        constexpr double kCutZ = -1e-4;
        if (from.z > to.z) std::swap(from, to);
        if (to.z > kCutZ) to = glm::mix(from, to, (kCutZ - from.z) / (to.z - from.z));
        shown += expectShownWithin(render(scene, wall, kDepth), kLineWidthPx, [&](glm::dvec2 px) {
            return from.z < kCutZ ? distanceToSegment(px, pinholePx(from), pinholePx(to)) : kInfinity;
        });
    }
    EXPECT_GT(shown, 2000);
}

// The full cylinder's formula, written apart from calibration/.
glm::dvec2 cylinderPx(glm::dvec3 p, glm::ivec2 sizePx) {
    const double scale = sizePx.x / (2 * kPi);
    return {sizePx.x / 2.0 + scale * std::atan2(p.x, -p.z),
            sizePx.y / 2.0 - scale * p.y / std::hypot(p.x, p.z)};
}

TEST(ReferenceStrokes, LinesAreCurvesOnACylinderAndGoAcrossItsBorder) {
    test::Random random(3);
    const glm::ivec2 sizePx(160, 120);
    const Wall wall = test::fullCylinderWall(sizePx);
    int shown = 0;
    for (int i = 0; i < 12; ++i) {
        const glm::dvec3 a(near(random)), b(near(random));
        Scene scene;
        addLines(scene, kWhite, {{glm::vec3(a), glm::vec3(b)}});
        std::vector<glm::dvec2> curve;
        constexpr int kSteps = 500;
        // Steps of equal angles; on the drawing of a full turn they are a fraction of a pixel.
        const double angle = std::acos(glm::dot(glm::normalize(a), glm::normalize(b)));
        for (int k = 0; k <= kSteps; ++k) {
            const double part = angle * k / kSteps;
            const double u = std::sin(part) / glm::length(b), v = std::sin(angle - part) / glm::length(a);
            curve.push_back(cylinderPx(glm::mix(a, b, u / (u + v)), sizePx));
        }
        shown += expectShownWithin(render(scene, wall, kDepth), kLineWidthPx, [&](glm::dvec2 px) {
            double least = kInfinity;
            for (size_t k = 1; k < curve.size(); ++k) {
                glm::dvec2 from = curve[k - 1], to = curve[k];
                for (glm::dvec2* end : {&from, &to})
                    end->x += sizePx.x * std::round((px.x - end->x) / sizePx.x);
                if (std::abs(from.x - to.x) < sizePx.x / 2.0)
                    least = std::min(least, distanceToSegment(px, from, to));
            }
            return least;
        });
    }
    EXPECT_GT(shown, 800);
}

TEST(ReferenceStrokes, TheDepthIsThatOfTheNearestPlaceOnTheLine) {
    test::Random random(4);
    const Wall wall = pinholeWall(kSizePx, kFocalPx);
    for (int i = 0; i < 50; ++i) {
        const glm::dvec3 a(-2, random.uniform(-1, 1), random.uniform(-8, -2)),
            b(2, random.uniform(-1, 1), random.uniform(-8, -2));
        Scene scene;
        addLines(scene, kWhite, {{glm::vec3(a), glm::vec3(b)}});
        const Frame position = render(scene, wall, kPosition), depth = render(scene, wall, kDepth);
        const glm::dvec2 fromPx = pinholePx(glm::vec3(a)), toPx = pinholePx(glm::vec3(b));
        for (int y = 0; y < kSizePx.y; ++y)
            for (int x = 0; x < kSizePx.x; ++x) {
                const glm::dvec3 p(rgb(position, x, y));
                if (!std::isfinite(p.x)) continue;
                const glm::dvec2 px(x + 0.5, y + 0.5);
                EXPECT_NEAR(glm::distance(pinholePx(p), px), distanceToSegment(px, fromPx, toPx), 0.01);
                EXPECT_LT(glm::length(glm::cross(p - a, b - a)), 1e-5 * glm::distance(a, b));
                EXPECT_NEAR(*depth.at(x, y), glm::length(p), 1e-5);
            }
    }
}

TEST(ReferenceStrokes, TheNearestWins) {
    const Wall wall = pinholeWall({9, 9}, 9);
    const auto colorWith = [&](float squareZ, Blending blending = Blending::none) {
        Scene scene;
        Material square = plainMaterial({0, 0, 1});
        square.baseColor.a = 0.5f;
        square.blending = blending;
        startMaterial(scene, square);
        addFrontalSquare(scene, {0.1f, 0.2f, squareZ}, 20);
        addLines(scene, plainMaterial({1, 0, 0}), {{glm::vec3(-1, 0, -2), glm::vec3(1, 0, -2)}});
        addPoints(scene, plainMaterial({0, 1, 0}), {{0, 0, -3}});
        return rgb(render(scene, wall, kColor), 4, 4);
    };
    EXPECT_EQ(colorWith(-1), glm::vec3(0, 0, 1));
    EXPECT_EQ(colorWith(-2.5f), glm::vec3(1, 0, 0));
    EXPECT_EQ(colorWith(-4), glm::vec3(1, 0, 0));
    EXPECT_EQ(colorWith(-1, Blending::alpha), glm::vec3(0.5f, 0, 0.5f));
    EXPECT_EQ(colorWith(-2.5f, Blending::alpha), glm::vec3(1, 0, 0));
}

TEST(ReferenceStrokes, TransparentStrokesMixOnceASampleWithSurfaces) {
    const Wall wall = test::fullCylinderWall({320, 240});
    Material glass = plainMaterial({0, 1, 0});
    glass.baseColor.a = 0.25f;
    glass.blending = Blending::alpha;
    Scene scene;
    addLines(scene, glass, {{glm::vec3(-3, 0.2f, -2), glm::vec3(3, 1, -2)}});
    Material solid = plainMaterial({1, 0, 0});
    startMaterial(scene, solid);
    addFrontalSquare(scene, {0.1f, 0.2f, -4}, 100);
    const Frame coverage = render(scene, wall, kCoverage), color = render(scene, wall, kColor),
                depth = render(scene, wall, kDepth);
    int shown = 0;
    for (int y = 0; y < 240; ++y)
        for (int x = 80; x < 240; ++x) {
            const float layers = *coverage.at(x, y);
            if (layers < 2) continue;
            ++shown;
            EXPECT_EQ(layers, 2);
            EXPECT_LT(glm::length(rgb(color, x, y) - glm::vec3(0.75f, 0.25f, 0)), 1e-6f);
            EXPECT_GT(*depth.at(x, y), 4);
        }
    EXPECT_GT(shown, 100);
}

TEST(ReferenceStrokes, TexturesAndNormalsAreInterpolatedAlongTheLine) {
    Scene scene;
    const Texture ramp = squareTexture(4, [](int, int size) {
        std::vector<glm::u8vec4> texels;
        texels.reserve(static_cast<size_t>(size) * static_cast<size_t>(size));
        for (int i = 0; i < size * size; ++i)
            texels.push_back(i % size < size / 2 ? glm::u8vec4(255, 0, 0, 255) : glm::u8vec4(0, 0, 255, 255));
        return texels;
    });
    Material material = texturedMaterial(scene, ramp);
    addLines(scene, material, {{glm::vec3(-4, 0, -4), glm::vec3(1, 0, -1)}});
    const Wall wall = pinholeWall({65, 65}, 32.5);
    const Frame frame = render(scene, wall, kColor);
    // The middle of the line, (-1.5, 0, -2.5), is at 13 px, not in the middle of the 65.
    EXPECT_EQ(rgb(frame, 5, 32), glm::vec3(1, 0, 0));
    EXPECT_EQ(rgb(frame, 25, 32), glm::vec3(0, 0, 1));

    scene.materials[0] = plainMaterial(glm::vec3(1));
    const glm::vec3 left(0.6f, 0.8f, 0), right(-0.8f, 0.6f, 0);
    scene.normals = {left, right};
    const Frame lit = render(scene, wall, {Style::textured, OutputKind::color});
    const glm::vec3 expected = shading::lightOnSurface(glm::normalize(left + right));
    EXPECT_LT(glm::length((rgb(lit, 12, 32) + rgb(lit, 13, 32)) / 2.0f - expected), 0.02f);
}

TEST(ReferenceStrokes, MaskedAndTooNearStrokesAreNotDrawn) {
    Scene scene;
    Material masked = plainMaterial(glm::vec3(1));
    masked.baseColor.a = 0.4f;
    masked.alphaCutoff = 0.5f;
    addPoints(scene, masked, {{0, 0, -2}});
    addPoints(scene, kWhite, {{0, 0, -1e-4f}});
    EXPECT_EQ(*render(scene, pinholeWall({1, 1}, 1, 11), kCoverage).at(0, 0), 0);
    EXPECT_EQ(*render(scene, pinholeWall({1, 1}, 1, 9), kCoverage).at(0, 0), 1);
    scene.materials[0].alphaCutoff = 0.3f;
    EXPECT_EQ(*render(scene, pinholeWall({1, 1}, 1, 11), kCoverage).at(0, 0), 1);
}

TEST(ReferenceStrokes, ThePictureDoesNotDependOnTheThreads) {
    test::Random random(5);
    Scene scene = boxRoom({8, 5, 6});
    std::vector<std::array<glm::vec3, 2>> lines;
    lines.reserve(200);
    for (int i = 0; i < 200; ++i) lines.push_back({near(random), near(random)});
    Material glass = plainMaterial({0, 1, 0});
    glass.baseColor.a = 0.5f;
    glass.blending = Blending::alpha;
    addLines(scene, glass, lines);
    const Wall wall = test::fullCylinderWall({160, 120});
    const Frame one = render(scene, wall, {Style::textured, OutputKind::color, 2, 1});
    for (const int threads : {0, 3})
        EXPECT_EQ(render(scene, wall, {Style::textured, OutputKind::color, 2, threads}).texels, one.texels);
}

}  // namespace
}  // namespace curvewall
