// Bounded ray casting through round lenses against the reference and against itself.

#include "renderer/bounded_raycast.h"

#include "calibration/errors.h"
#include "calibration/pieces/pixel_rays.h"
#include "renderer/names.h"
#include "renderer/scene/load_scene.h"
#include "renderer/shown_error.h"
#include "tests/renderer/seen_triangles.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/lens_walls.h"
#include "tests/support/random_numbers.h"
#include "tests/support/rendering.h"
#include "tests/support/test_scenes.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace curvewall {
namespace {

using test::kPi;
constexpr glm::ivec2 kSizePx(256, 192);
constexpr std::array kAllBounds{BoundingShape::triangle, BoundingShape::quad, BoundingShape::genericQuad};
const test::LensKind kHalfTurn{"Equidistant180", {RadialModel::equidistant}, 180};

RenderRequest boundedRequest(const Wall& wall, Scene scene, Camera camera = {}) {
    RenderRequest request = test::requestFor(wall, std::move(scene), camera);
    request.method = Method::boundedRaycast;
    return request;
}

Camera cityCamera(double yawDeg = 0) { return {{0, 8, 0}, {yawDeg * kPi / 180, 0, 0}}; }

// Pixels whose coverage is not one for each that the display has a ray for.
int wronglyCovered(const Frame& coverage, const Display& display) {
    const PixelRays rays(*display.projection, display.sizePx);
    int wrong = 0;
    for (int y = 0; y < coverage.sizePx.y; ++y)
        for (int x = 0; x < coverage.sizePx.x; ++x)
            wrong += *coverage.at(x, y) != (rays.has({x, y}) ? 1.0f : 0.0f);
    return wrong;
}

class BoundedRaycast : public test::GlTest {
protected:
    Frame frameOf(const RenderRequest& request) { return renderer_.render(request).frame; }
    double shareOff(const RenderRequest& request) {
        return compareColor(frameOf(request), test::referenceOf(request).frame).shareOff;
    }

    Renderer renderer_;
};

class EveryLens : public BoundedRaycast, public testing::WithParamInterface<test::LensKind> {};

INSTANTIATE_TEST_SUITE_P(BoundedRaycast, EveryLens, testing::ValuesIn(test::lensKinds()),
                         [](const auto& lens) { return lens.param.name; });

TEST_P(EveryLens, AgreesWithTheReference) {
    const ScenePtr city = std::make_shared<const Scene>(loadScene("city:2000"));
    for (const Orientation& orientation : {Orientation{}, test::kTurned}) {
        RenderRequest request =
            boundedRequest(test::lensWall(GetParam(), kSizePx, orientation), {}, cityCamera(20));
        request.scene = city;
        const ImageDifference difference = compareColor(frameOf(request), test::referenceOf(request).frame);
        // Rays are the same; texture filters differ by some, and ties at edges.
        EXPECT_LT(difference.shareOff, 0.001);
        EXPECT_GT(difference.psnrDb, 40);
    }
}

TEST_P(EveryLens, AllBoundingShapesGiveTheSameBytes) {
    RenderRequest request = boundedRequest(test::lensWall(GetParam(), kSizePx, test::kTurned),
                                           loadScene("city:2000"), cityCamera());
    for (const OutputKind output : {OutputKind::color, OutputKind::coverage}) {
        request.output = output;
        request.bounds = BoundingShape::triangle;
        const Frame triangle = frameOf(request);
        request.bounds = BoundingShape::quad;
        EXPECT_EQ(frameOf(request).texels, triangle.texels);
        request.bounds = BoundingShape::genericQuad;
        EXPECT_EQ(frameOf(request).texels, triangle.texels);
    }
}

TEST_P(EveryLens, AClosedRoomCoversEveryRayExactlyOnce) {
    test::Random random(1);
    RenderRequest request = boundedRequest(test::lensWall(GetParam(), kSizePx), loadScene("room"));
    request.output = OutputKind::coverage;
    for (int i = 0; i < 30; ++i) {
        request.bounds = kAllBounds[static_cast<size_t>(i) % kAllBounds.size()];
        // Up to a centimetre from the walls.
        request.camera = {
            {random.uniform(-2.99, 2.99), random.uniform(-1.4, 1.4), random.uniform(-2.99, 2.99)},
            {random.uniform(-kPi, kPi), random.uniform(-kPi / 2, kPi / 2), random.uniform(-kPi, kPi)}};
        if (i < 10) request.camera = {{}, {i * kPi / 4, (i % 3 - 1) * kPi / 2, 0}};
        ASSERT_EQ(wronglyCovered(frameOf(request), request.wall->displays[0]), 0) << "eye " << i;
    }
}

TEST_P(EveryLens, ShowsPointsWithinAHundredthOfAPixel) {
    RenderRequest request = boundedRequest(test::lensWall(GetParam(), {1024, 1024}, test::kTurned),
                                           loadScene("room"), {{0.4, 0.3, -0.8}, {0.2, 0.1, 0.3}});
    request.output = OutputKind::position;
    const Display& display = request.wall->displays[0];
    const Frame position = frameOf(request);
    const PixelRays rays(*display.projection, display.sizePx);
    const PixelDistance distance(display);
    // Straight behind is all around the rim of a picture of a full turn, where the roundings of a direction
    // in single precision are pixels: it must be right but for them.
    constexpr double kRoundingsRad = 4e-7;
    double worstPx = 0;
    int shown = 0, rounded = 0;
    for (int y = 0; y < display.sizePx.y; ++y)
        for (int x = 0; x < display.sizePx.x; ++x) {
            const float* const texel = position.at(x, y);
            if (std::isnan(texel[0])) continue;
            ++shown;
            const glm::dvec3 point(texel[0], texel[1], texel[2]);
            const double offPx = distance.from(glm::dvec2(x, y) + 0.5, point).value_or(1e9);
            if (offPx > 0.01 &&
                glm::distance(glm::normalize(point), glm::normalize(rays.at({x, y}))) < kRoundingsRad)
                ++rounded;
            else
                worstPx = std::max(worstPx, offPx);
        }
    EXPECT_LT(worstPx, 0.01);
    EXPECT_GT(worstPx, 0);
    EXPECT_GT(shown, 500'000);
    EXPECT_LT(rounded, GetParam().fovDeg < 360 ? 1 : 0.001 * shown);
}

TEST_P(EveryLens, StatsTellTheErrorOfWhatItShows) {
    RenderRequest request = boundedRequest(test::lensWall(GetParam(), kSizePx, test::kTurned),
                                           loadScene("room"), {{0.4, 0.3, -0.8}, {0.2, 0.1, 0.3}});
    request.measuresError = true;
    const GeometricError told = renderer_.render(request).stats.geometricError;
    request.output = OutputKind::position;
    const Certificate error = shownError(frameOf(request), request.wall->displays[0]);
    EXPECT_EQ(told.maxPx, error.maxPx);
    EXPECT_EQ(told.meanPx, error.meanPx);
}

TEST_P(EveryLens, DepthIsTheDistanceToThePosition) {
    RenderRequest request = boundedRequest(test::lensWall(GetParam(), kSizePx, test::kTurned),
                                           loadScene("city:2000"), cityCamera(50));
    request.output = OutputKind::position;
    const Frame position = frameOf(request), expected = test::referenceOf(request).frame;
    request.output = OutputKind::depth;
    const Frame depth = frameOf(request);
    int off = 0;
    for (size_t i = 0; i < depth.texels.size(); ++i) {
        const glm::vec3 shown(position.texels[3 * i], position.texels[3 * i + 1], position.texels[3 * i + 2]);
        const glm::vec3 truth(expected.texels[3 * i], expected.texels[3 * i + 1], expected.texels[3 * i + 2]);
        ASSERT_EQ(std::isnan(shown.x), std::isinf(depth.texels[i]));
        if (!std::isnan(shown.x)) {
            ASSERT_NEAR(depth.texels[i], glm::length(shown), 1e-6 * glm::length(shown));
        }
        off += std::isnan(shown.x) != std::isnan(truth.x) ||
               glm::distance(shown, truth) > 1e-3f * glm::length(truth);
    }
    EXPECT_LT(off, 0.0005 * static_cast<double>(depth.texels.size()));
}

TEST_F(BoundedRaycast, ARayExactlyThroughACornerMeetsOneTriangle) {
    // An odd picture looks straight ahead through its middle pixel, where all triangles of a fan meet, on a
    // plane and at the tip of a pyramid.
    for (const float tip : {0.0f, 1.0f, -1.0f}) {
        for (int spokes = 3; spokes < 9; ++spokes) {
            Scene fan;
            startMaterial(fan, plainMaterial(glm::vec3(1)));
            const auto rim = [&](int i) {
                const double angle = 2 * kPi * (i % spokes) / spokes + 0.3;
                return glm::vec3(9 * std::cos(angle), 9 * std::sin(angle), -3);
            };
            for (int i = 0; i < spokes; ++i) addTriangle(fan, {glm::vec3(0, 0, tip - 3), rim(i), rim(i + 1)});
            RenderRequest request =
                boundedRequest(test::lensWall({"Narrow", {RadialModel::equidistant}, 50}, {101, 101}), fan);
            request.output = OutputKind::coverage;
            EXPECT_EQ(wronglyCovered(frameOf(request), request.wall->displays[0]), 0) << tip << ' ' << spokes;
        }
    }
}

TEST_F(BoundedRaycast, WhatIsNearerThanTheNearLimitIsCut) {
    Scene scene;
    startMaterial(scene, plainMaterial({1, 0, 0}));
    addFrontalSquare(scene, {0, 0, -2}, 20);
    startMaterial(scene, plainMaterial({0, 1, 0}));
    addFrontalSquare(scene, {0, 0, -0.9e-5f}, 0.5e-5f);
    startMaterial(scene, plainMaterial({0, 0, 1}));
    addFrontalSquare(scene, {0, 0, -1.1e-5f}, 0.2e-5f);
    RenderRequest request = boundedRequest(test::lensWall(kHalfTurn, {101, 101}), scene);
    request.style = Style::unlit;
    EXPECT_EQ(shareOff(request), 0);
    const Frame frame = frameOf(request);
    EXPECT_EQ(frame.at(50, 50)[2], 1);  // the blue square hides the red one, the green one is cut
    EXPECT_EQ(frame.at(56, 50)[0], 1);
}

TEST_F(BoundedRaycast, TrianglesSeenFromBehindAreDrawnOnlyWhenTheirMaterialIsDoubleSided) {
    for (const bool doubleSided : {true, false}) {
        Scene scene;
        Material material = plainMaterial({0.9, 0.5, 0.1});
        material.doubleSided = doubleSided;
        startMaterial(scene, material);
        addFrontalSquare(scene, {0, 0, -3}, 3);
        addQuad(scene, {glm::vec3(2, -1, -1), glm::vec3(2, -1, 1), glm::vec3(2, 1, 1), glm::vec3(2, 1, -1)});
        addQuad(scene,
                {glm::vec3(-2, -1, -1), glm::vec3(-2, -1, 1), glm::vec3(-2, 1, 1), glm::vec3(-2, 1, -1)});
        EXPECT_LT(shareOff(boundedRequest(test::lensWall(kHalfTurn, kSizePx), scene)), 1e-4) << doubleSided;
    }
}

TEST_F(BoundedRaycast, AlphaMasksLetTheBackgroundThrough) {
    const RenderRequest request = boundedRequest(test::lensWall(kHalfTurn, kSizePx), maskedSquare());
    EXPECT_LT(shareOff(request), 0.001);
    EXPECT_EQ(*frameOf(request).at(140, 96), 0);  // the transparent half
}

TEST_F(BoundedRaycast, SurfacesMixFarToNear) {
    Scene scene = boxRoom({8, 5, 8});
    const auto addPane = [&](glm::vec4 color, Blending blending, glm::vec3 centreM) {
        Material material;
        material.baseColor = color;
        material.blending = blending;
        startMaterial(scene, material);
        addFrontalSquare(scene, centreM, 2.5f);
    };
    addPane({0.1, 0.2, 0.9, 0.6}, Blending::alpha, {0.5, 0, -2});
    addPane({0.9, 0.1, 0.1, 0.5}, Blending::alpha, {-0.7, 0.3, -3});
    addPane({0.1, 0.3, 0.1, 0.5}, Blending::additive, {0, -0.5, -1});
    addPane({0.3, 0.8, 0.2, 0.4}, Blending::alpha, {0.2, 0.6, 3});
    for (const test::LensKind& kind : {kHalfTurn, test::LensKind{"Wide", {RadialModel::equisolid}, 300}}) {
        RenderRequest request = boundedRequest(test::lensWall(kind, kSizePx, test::kTurned), scene);
        request.style = Style::unlit;
        for (const BoundingShape bounds : kAllBounds) {
            request.bounds = bounds;
            EXPECT_LT(shareOff(request), 2e-4) << kind.name;
        }
    }
}

TEST_F(BoundedRaycast, TexturesAreFilteredByTheirFootprint) {
    // A floor to the horizon: from magnified texels at the eye's feet to the last level.
    Scene scene;
    std::vector<uint8_t> greys;
    for (int level = 0; level < 9; ++level) greys.push_back(static_cast<uint8_t>(20 + 25 * level));
    startMaterial(scene, texturedMaterial(scene, levelsTexture(256, greys)));
    addQuad(scene,
            {glm::vec3(-400, -1.5, 400), glm::vec3(400, -1.5, 400), glm::vec3(400, -1.5, -400),
             glm::vec3(-400, -1.5, -400)},
            200);
    for (const test::LensKind& kind : {kHalfTurn, test::LensKind{"Curvilinear", {}, 100, true}}) {
        RenderRequest request = boundedRequest(test::lensWall(kind, {512, 384}), scene);
        EXPECT_LT(shareOff(request), 0.001) << kind.name;
        // Finer where a sample is a quarter of a pixel.
        request.samples = 4;
        EXPECT_GT(compareColor(frameOf(request), test::referenceOf(request).frame).psnrDb, 25) << kind.name;
    }
}

TEST_F(BoundedRaycast, AnisotropyKeepsWhatLiesAlongTheGaze) {
    // Stripes away from the eye: isotropic filters wash them out long before the horizon.
    Scene scene;
    const Texture stripes = squareTexture(64, [](int, int size) {
        std::vector<glm::u8vec4> texels;
        for (int i = 0; i < size * size; ++i) {
            const auto grey = static_cast<uint8_t>(size == 1 ? 128 : i % size < size / 2 ? 0 : 255);
            texels.emplace_back(grey, grey, grey, 255);
        }
        return texels;
    });
    startMaterial(scene, texturedMaterial(scene, stripes));
    addQuad(scene,
            {glm::vec3(-40, -1, 0), glm::vec3(40, -1, 0), glm::vec3(40, -1, -40), glm::vec3(-40, -1, -40)},
            20);
    RenderRequest request = boundedRequest(test::lensWall(kHalfTurn, {400, 400}), scene);
    const auto contrast = [&](int anisotropy) {
        request.anisotropy = anisotropy;
        const Frame frame = frameOf(request);
        double sum = 0;
        for (int y = 205; y < 260; ++y)
            for (int x = 150; x < 249; ++x) sum += std::abs(frame.at(x + 1, y)[0] - frame.at(x, y)[0]);
        return sum;
    };
    EXPECT_GT(contrast(16), 1.2 * contrast(1));
}

TEST_F(BoundedRaycast, MoreSamplesComeNearerToTheConvergedPicture) {
    const std::vector<double> psnrDb = test::psnrDbOfMoreSamples(
        renderer_,
        boundedRequest(test::lensWall(kHalfTurn, kSizePx), loadScene("city:2000"), cityCamera(20)));
    EXPECT_GT(psnrDb[1], psnrDb[0] + 2);
    EXPECT_GT(psnrDb[2], psnrDb[1] + 2);
}

TEST_F(BoundedRaycast, EverySampleOfAClosedRoomIsCovered) {
    // A curvilinear view fills its rectangle.
    RenderRequest request = boundedRequest(
        test::lensWall({"Curvilinear", {}, 130, true}, kSizePx, test::kTurned), loadScene("room"));
    Wall pinkOutside = *request.wall;
    pinkOutside.background = {100, 0, 100};
    request.wall = std::make_shared<const Wall>(pinkOutside);
    request.linearOutput = true;
    for (const int samples : {4, 16, 65}) {
        request.samples = samples;
        const Frame frame = frameOf(request);
        EXPECT_LT(*std::ranges::max_element(frame.texels), 1.5f) << samples << " samples";
    }
}

TEST_F(BoundedRaycast, LineStylesAgreeWithTheReference) {
    for (const Style style : {Style::wireframe, Style::penAndInk}) {
        for (const test::LensKind& kind :
             {kHalfTurn, test::LensKind{"Wide", {RadialModel::stereographic}, 270}}) {
            RenderRequest request = boundedRequest(test::lensWall(kind, {400, 400}, test::kTurned),
                                                   boxRoom({8, 5, 8}), {{1, 0.5, -0.7}, {0.3, 0.1, 0.2}});
            request.style = style;
            EXPECT_LT(shareOff(request), 0.001) << kind.name;
        }
    }
}

TEST_F(BoundedRaycast, ScenesFarFromTheOriginRenderLikeThoseBesideIt) {
    RenderRequest request =
        boundedRequest(test::lensWall(kHalfTurn, kSizePx), loadScene("city:2000"), cityCamera(20));
    const Frame beside = frameOf(request);
    const glm::dvec3 farM(1e6, -2e5, 3e6);
    Scene moved = *request.scene;
    moved.originM += farM;
    request.scene = std::make_shared<const Scene>(std::move(moved));
    request.camera.positionM += farM;
    EXPECT_EQ(compareColor(frameOf(request), beside).shareOff, 0);
}

TEST_F(BoundedRaycast, StatsCountTheFragmentsOfFrameZero) {
    RenderRequest request =
        boundedRequest(test::lensWall(kHalfTurn, kSizePx), loadScene("city:2000"), cityCamera(20));
    request.output = OutputKind::coverage;
    request.measuresError = true;
    for (const BoundingShape bounds : kAllBounds) {
        request.bounds = bounds;
        const RenderResult result = renderer_.render(request);
        double drawn = 0;
        for (const float count : result.frame.texels) drawn += count;
        EXPECT_EQ(static_cast<double>(result.stats.renderedFragments), drawn);
        EXPECT_GT(result.stats.coveredFragments, result.stats.renderedFragments);
        EXPECT_EQ(result.stats.bounds, nameOf(bounds));
        EXPECT_GT(result.stats.pairs, 0u);
        EXPECT_LT(result.stats.pairs, result.stats.triangles);  // those behind the lens are left out
    }
}

class HalfTurnLens : public EveryLens {};

std::vector<test::LensKind> halfTurnLenses() {
    std::vector<test::LensKind> kinds = test::lensKinds();
    std::erase_if(kinds, [](const test::LensKind& kind) { return kind.fovDeg != 180; });
    return kinds;
}

INSTANTIATE_TEST_SUITE_P(BoundedRaycast, HalfTurnLens, testing::ValuesIn(halfTurnLenses()),
                         [](const auto& lens) { return lens.param.name; });

// As the paper's table 3 counts: fragments of the bounds over those of what they bound.
TEST_P(HalfTurnLens, FewFragmentsOfTrianglesBelowFiveDegreesAreInVain) {
    test::Random random(12);
    Scene small;
    startMaterial(small, plainMaterial(glm::vec3(1)));
    for (int i = 0; i < 2'000; ++i) {
        const test::Triangle triangle = test::anySmall(random);
        addTriangle(small, {3.0 * triangle[0], 3.0 * triangle[1], 3.0 * triangle[2]});
    }
    RenderRequest request = boundedRequest(test::lensWall(GetParam(), {512, 512}), std::move(small));
    request.style = Style::unlit;
    request.measuresError = true;
    const auto overdraw = [&](BoundingShape bounds) {
        request.bounds = bounds;
        const RenderStats stats = renderer_.render(request).stats;
        EXPECT_GT(stats.renderedFragments, 10'000u);
        RecordProperty(std::string(nameOf(bounds)), std::to_string(100 * stats.overdraw()));
        return stats.overdraw();
    };
    EXPECT_LE(overdraw(BoundingShape::triangle), 0.15);
    EXPECT_LE(overdraw(BoundingShape::quad), 1.20);
    EXPECT_GT(overdraw(BoundingShape::genericQuad), 1.20);
}

TEST_F(BoundedRaycast, OtherDisplaysAreRefusedByName) {
    const auto messageFor = [&](const Wall& wall, Scene scene) -> std::string {
        try {
            renderer_.render(boundedRequest(wall, std::move(scene)));
        } catch (const UsageError& error) {
            return error.what();
        }
        return "drawn";
    };
    EXPECT_THAT(messageFor(test::fullCylinderWall(kSizePx), boxRoom({8, 5, 8})),
                testing::AllOf(testing::HasSubstr("round lenses seen from the lens"),
                               testing::HasSubstr("cylinder")));
    Wall dome = test::lensWall(kHalfTurn, kSizePx);
    dome.displays[0].projection = std::make_shared<DomeProjection>(
        circularLens({RadialModel::equidistant}, kPi, kSizePx), Pose{}, DomeSurface{}, glm::dvec3(0.2, 0, 0));
    EXPECT_THAT(messageFor(dome, boxRoom({8, 5, 8})), testing::HasSubstr("on a dome"));
    Scene points = boxRoom({8, 5, 8});
    addPoints(points, plainMaterial(glm::vec3(1)), {{0, 0, -1}});
    EXPECT_THAT(messageFor(test::lensWall(kHalfTurn, kSizePx), points), testing::HasSubstr("1 points"));
}

}  // namespace
}  // namespace curvewall
