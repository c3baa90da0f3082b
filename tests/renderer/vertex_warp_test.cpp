// Vertices at their places on the screen with straight lines in between, against projections and the
// reference.

#include "renderer/vertex_warp.h"

#include "calibration/errors.h"
#include "calibration/pieces/ownership.h"
#include "calibration/pieces/pixel_rays.h"
#include "renderer/display_facts.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/lens_walls.h"
#include "tests/support/random_numbers.h"
#include "tests/support/rendering.h"
#include "tests/support/shipped_walls.h"
#include "tests/support/small_walls.h"
#include "tests/support/test_scenes.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

using test::kPi;
constexpr glm::ivec2 kSizePx(320, 240);
const test::LensKind kDome{"Equidistant180", {RadialModel::equidistant}, 180};

RenderRequest warpRequest(const Wall& wall, Scene scene, Camera camera = {}, double tessellationPx = 8) {
    RenderRequest request = test::requestFor(wall, std::move(scene), camera);
    request.method = Method::vertexWarp;
    request.tessellationPx = tessellationPx;
    return request;
}

struct Cover {
    int missing = 0, twice = 0, inHoles = 0;
};

Cover coverOf(const Frame& coverage, const Display& display) {
    const PixelRays rays(*display.projection, display.sizePx);
    Cover cover;
    for (int y = 0; y < coverage.sizePx.y; ++y)
        for (int x = 0; x < coverage.sizePx.x; ++x) {
            const float fragments = *coverage.at(x, y);
            cover.inHoles += !rays.has({x, y}) && fragments != 0;
            cover.missing += rays.has({x, y}) && fragments == 0;
            cover.twice += fragments > 1;
        }
    return cover;
}

class VertexWarp : public test::GlTest {
protected:
    RenderResult render(const RenderRequest& request) { return renderer_.render(request); }
    Frame frameOf(const RenderRequest& request) { return render(request).frame; }
    double shareOff(const RenderRequest& request) {
        return compareColor(frameOf(request), test::referenceOf(request).frame).shareOff;
    }
    GeometricError errorAt(RenderRequest request, double tessellationPx) {
        request.tessellationPx = tessellationPx;
        request.measuresError = true;
        return render(request).stats.geometricError;
    }
    // Pixels that only one of it and the reference shows something at.
    int disagreements(RenderRequest request) {
        request.output = OutputKind::depth;
        return test::disagreementsOnCover(frameOf(request), test::referenceOf(request).frame);
    }

    Renderer renderer_;
};

class VertexWarpOn : public VertexWarp, public testing::WithParamInterface<std::string> {
protected:
    Wall wall() const { return test::shippedWall(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Walls, VertexWarpOn, testing::ValuesIn(test::shippedWallNames()),
                         [](const auto& wall) {
                             std::string name = wall.param;
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

// Cracks would show nothing, overlaps show twice.
TEST_P(VertexWarpOn, AClosedRoomCoversEveryRayOnce) {
    RenderRequest request = warpRequest(wall(), loadScene("room"));
    request.output = OutputKind::coverage;
    for (const Camera& camera : {Camera{}, Camera{{2.9, -1.2, 0.4}, {0.7, 0.3, 0.2}}})
        for (const double tessellationPx : {8.0, 50.0}) {
            request.camera = camera;
            request.tessellationPx = tessellationPx;
            const Cover cover = coverOf(frameOf(request), request.wall->displays[0]);
            EXPECT_EQ(cover.missing, 0) << tessellationPx;
            EXPECT_EQ(cover.inHoles, 0) << tessellationPx;
            // Beside a pole some pixels are; and lines that bend this far, as at the rim of an orthographic
            // lens, fold over one another.
            const double bentPx = strokeErrorPx(factsOf(request.wall->displays[0]), tessellationPx);
            if (std::isinf(bentPx) || bentPx < 25) {
                EXPECT_LE(cover.twice, 8) << tessellationPx;
            }
        }
}

// Straight lines may fold over one another, but whatever is connected stays so.
TEST_P(VertexWarpOn, UndividedTrianglesLeaveNoGapsInARoom) {
    RenderRequest request = warpRequest(wall(), loadScene("room"), {}, 0);
    request.output = OutputKind::coverage;
    const Cover cover = coverOf(frameOf(request), request.wall->displays[0]);
    EXPECT_EQ(cover.missing, 0);
    EXPECT_EQ(cover.inHoles, 0);
}

// An eye anywhere in a box of this size about the scene's origin, every other one close to one of its sides.
Camera cameraIn(glm::dvec3 sizeM, int nth, glm::dvec3 eyeInWallM, test::Random& random) {
    const glm::dvec3 mostM = 0.499 * sizeM;
    glm::dvec3 eyeM = mostM * random.inBox(1);
    if (nth % 2 == 1) {
        const int axis = static_cast<int>(random.uniform(0, 3));
        eyeM[axis] = 0.5 * sizeM[axis] - std::exp(random.uniform(-7, 0));
    }
    Camera camera{{},
                  {random.uniform(-kPi, kPi), random.uniform(-kPi / 2, kPi / 2), random.uniform(-kPi, kPi)}};
    camera.positionM = eyeM - eyeInScene(camera, eyeInWallM);
    return camera;
}

// Long straight edges are off from where they belong, but whatever is connected stays so: up to the borders,
// across the seams of closed displays and around their poles.
TEST_P(VertexWarpOn, AClosedRoomLeavesNothingOpenHoweverLongEdgesAre) {
    for (const glm::dvec3 sizeM : {glm::dvec3(8, 5, 8), glm::dvec3(100, 3, 3)}) {
        RenderRequest request = warpRequest(test::smallShippedWall(GetParam(), 5), boxRoom(sizeM));
        request.output = OutputKind::coverage;
        test::Random random(7);
        for (int i = 0; i < 4; ++i) {
            request.camera = cameraIn(sizeM, i, request.wall->eyeM, random);
            for (const double tessellationPx : {0.0, 1.0, 8.0, 40.0, 200.0}) {
                request.tessellationPx = tessellationPx;
                const Cover cover = coverOf(frameOf(request), request.wall->displays[0]);
                EXPECT_EQ(cover.missing, 0) << i << " " << tessellationPx;
                EXPECT_EQ(cover.inHoles, 0) << i << " " << tessellationPx;
            }
        }
    }
}

// Small triangles all around, each on its own: the pixel that the projection has its middle at shows it.
TEST_P(VertexWarpOn, VerticesLandWhereTheProjectionHasThem) {
    const Wall onWall = wall();
    const Display& display = onWall.displays.front();
    test::Random random(3);
    Scene scene;
    startMaterial(scene, plainMaterial(glm::vec3(1)));
    std::vector<glm::dvec2> pixels;
    std::vector<glm::dvec3> middles;
    constexpr double kRadiusPx = 4;
    while (pixels.size() < 200) {
        const glm::dvec2 px = random.pixel(display.sizePx);
        const auto corner = [&](double angle) {
            return display.projection->unproject(px +
                                                 kRadiusPx * glm::dvec2(std::cos(angle), std::sin(angle)));
        };
        const auto middle = display.projection->unproject(px);
        const auto a = corner(0), b = corner(2.1), c = corner(4.2);
        const bool isApart = std::ranges::none_of(
            pixels, [&](glm::dvec2 other) { return glm::distance(other, px) < 4 * kRadiusPx; });
        const bool isInside =
            px.x > 8 && px.y > 8 && px.x < display.sizePx.x - 8 && px.y < display.sizePx.y - 8;
        if (!middle || !a || !b || !c || !isApart || !isInside) continue;
        const double distanceM = random.uniform(2, 30);
        const auto at = [&](glm::dvec3 ray) { return onWall.eyeM + distanceM * glm::normalize(ray); };
        addTriangle(scene, {glm::vec3(at(*a)), glm::vec3(at(*b)), glm::vec3(at(*c))});
        pixels.push_back(px);
        middles.push_back(at(*middle) - onWall.eyeM);
    }
    RenderRequest request = warpRequest(onWall, scene);
    request.output = OutputKind::position;
    for (const double tessellationPx : {0.0, 4.0}) {
        request.tessellationPx = tessellationPx;
        const Frame frame = frameOf(request);
        // Edges are straight however far the display bends them.
        const double edgePx = tessellationPx > 0 ? tessellationPx : 2 * kRadiusPx;
        const double mostPx = 0.1 + std::min(strokeErrorPx(factsOf(display), edgePx), 1.5);
        int off = 0;
        for (size_t i = 0; i < pixels.size(); ++i) {
            const float* shown = frame.at(static_cast<int>(pixels[i].x), static_cast<int>(pixels[i].y));
            const glm::dvec3 point(shown[0], shown[1], shown[2]);
            double nearestPx = 1e9;
            if (std::isfinite(point.x))
                for (const glm::dvec2 px : display.projection->project(point))
                    nearestPx = std::min(nearestPx, glm::distance(px, glm::floor(pixels[i]) + 0.5));
            off += !(nearestPx < mostPx && std::abs(glm::length(point) / glm::length(middles[i]) - 1) < 0.01);
        }
        EXPECT_LE(off, 2) << tessellationPx;
    }
}

// The rim of a full turn is one direction: what lies behind the lens is torn there, and a straight edge along
// the rim cuts off as much as the middle of an arc of 45 degrees, or of the edge's length, lies from its
// ends.
TEST_F(VertexWarp, RoundPicturesOfLessThanAFullTurnAreFilledToTheRim) {
    constexpr double kRadiusPx = 120;
    for (const test::LensKind& kind : test::lensKinds()) {
        RenderRequest request = warpRequest(test::lensWall(kind, kSizePx), boxRoom({8, 5, 8}));
        request.output = OutputKind::coverage;
        const PixelRays rays(*request.wall->displays[0].projection, kSizePx);
        test::Random random(8);
        for (int i = 0; i < 8; ++i) {
            request.camera = cameraIn({8, 5, 8}, i, {}, random);
            for (const double tessellationPx : {0.0, 8.0, 40.0}) {
                request.tessellationPx = tessellationPx;
                const Frame frame = frameOf(request);
                const double arcPx = tessellationPx > 0 ? tessellationPx : kPi / 4 * kRadiusPx;
                const double cutOffPx = kRadiusPx * (1 - std::cos(0.5 * arcPx / kRadiusPx));
                const double filledPx = kind.fovDeg < 360 ? 1e9 : kRadiusPx - cutOffPx - 1;
                for (int y = 0; y < kSizePx.y; ++y)
                    for (int x = 0; x < kSizePx.x; ++x)
                        if (rays.has({x, y}) &&
                            glm::distance(centreOf({x, y}), 0.5 * glm::dvec2(kSizePx)) < filledPx) {
                            ASSERT_GT(*frame.at(x, y), 0)
                                << kind.name << " " << i << " " << tessellationPx << ": " << x << ", " << y;
                        }
            }
        }
    }
}

TEST_F(VertexWarp, ErrorFallsAsTheSquareOfTheLength) {
    for (const Wall& wall : {test::fullCylinderWall({640, 480}), test::lensWall(kDome, {480, 480})}) {
        const RenderRequest request = warpRequest(wall, loadScene("room"), {{0.4, 0.3, -0.8}, {0.2, 0.1, 0}});
        const GeometricError at32 = errorAt(request, 32), at16 = errorAt(request, 16),
                             at8 = errorAt(request, 8);
        EXPECT_NEAR(at32.meanPx / at16.meanPx, 4, 1.2);
        EXPECT_NEAR(at16.meanPx / at8.meanPx, 4, 1.2);
        EXPECT_NEAR(at16.maxPx / at8.maxPx, 4, 2);
        EXPECT_LT(at8.maxPx, 0.5);
        EXPECT_GT(errorAt(request, 0).maxPx, at32.maxPx);
    }
}

// Thinner on the screen than the rasterizer's grid is fine.
TEST_F(VertexWarp, TrianglesSeenEdgeOnShowNoPointsFarOutsideThem) {
    test::Random random(6);
    Scene scene;
    startMaterial(scene, plainMaterial(glm::vec3(1)));
    for (int i = 0; i < 20'000; ++i) {
        const glm::dvec3 ahead = random.direction();
        const glm::dvec3 aside = glm::normalize(glm::cross(ahead, random.direction()));
        const glm::dvec3 middle = random.uniform(5, 100) * ahead;
        const double size = 0.1 * glm::length(middle), offEdge = 1e-3 * random.uniform(-1, 1);
        const glm::dvec3 across = glm::normalize(glm::cross(ahead, aside));
        addTriangle(scene, {glm::vec3(middle - 0.5 * size * aside), glm::vec3(middle + 0.5 * size * aside),
                            glm::vec3(middle + 0.4 * size * (aside + ahead + offEdge * across))});
    }
    for (const Wall& wall : {test::lensWall(kDome, {1024, 1024}), test::fullCylinderWall({1600, 1200})}) {
        RenderRequest request = warpRequest(wall, scene, {}, 16);
        EXPECT_LT(errorAt(request, 16).maxPx, 3) << wall.name;
    }
}

TEST_F(VertexWarp, IsExactWhereStraightLinesStayStraight) {
    const RenderRequest request =
        warpRequest(test::planarWall(kSizePx, 100), loadScene("city:2000"), {{0, 8, 0}, {}}, 0);
    EXPECT_LT(errorAt(request, 0).maxPx, 0.05);
    EXPECT_LT(shareOff(request), 0.001);
}

TEST_F(VertexWarp, AgreesWithTheReferenceWhereEdgesAreShort) {
    for (const test::LensKind& kind : test::lensKinds()) {
        RenderRequest request = warpRequest(test::lensWall(kind, kSizePx, test::kTurned),
                                            loadScene("city:2000"), {{0, 8, 0}, {}}, 4);
        EXPECT_LT(shareOff(request), 0.005) << kind.name;
    }
}

TEST_F(VertexWarp, ShortEdgesLeaveNoCracks) {
    test::Random random(4);
    for (const Wall& wall : {test::fullCylinderWall(kSizePx), test::lensWall(kDome, kSizePx)}) {
        RenderRequest request = warpRequest(wall, loadScene("room"));
        request.output = OutputKind::coverage;
        for (int i = 0; i < 12; ++i) {
            request.tessellationPx = std::array{2.0, 5.0, 13.0}[static_cast<size_t>(i % 3)];
            request.camera = {
                {random.uniform(-2.99, 2.99), random.uniform(-1.4, 1.4), random.uniform(-2.99, 2.99)},
                {random.uniform(-kPi, kPi), random.uniform(-1, 1), random.uniform(-kPi, kPi)}};
            EXPECT_EQ(coverOf(frameOf(request), request.wall->displays[0]).missing, 0)
                << i << " " << request.tessellationPx;
        }
    }
}

// What Oros warns of: large triangles close to the eye, beside it and behind it.
TEST_F(VertexWarp, TrianglesAroundTheEyeLeaveNoSmears) {
    test::Random random(5);
    const std::vector<Wall> walls{
        test::fullCylinderWall(kSizePx), test::lensWall(kDome, kSizePx, {0, kPi / 2, 0}),
        test::lensWall({"Curvilinear130", {}, 130, true}, kSizePx), test::planarWall(kSizePx, 90)};
    for (int i = 0; i < 30; ++i) {
        Scene scene;
        startMaterial(scene, plainMaterial(glm::vec3(1)));
        const auto somewhere = [&] {
            return glm::vec3(random.direction() * std::exp(random.uniform(-4, 5)));
        };
        addTriangle(scene, {somewhere(), somewhere(), somewhere()});
        for (const Wall& wall : walls) {
            EXPECT_LE(disagreements(warpRequest(wall, scene)), 30) << i << " " << wall.name;
            // Lines of 45 degrees without a vertex bend, but reach nowhere else.
            EXPECT_LE(disagreements(warpRequest(wall, scene, {}, 0)), 0.06 * kSizePx.x * kSizePx.y)
                << i << " " << wall.name;
        }
    }
}

// Most of these pictures is what lies straight behind, where the mean of depth and distance is nearly
// nothing.
TEST_F(VertexWarp, LensesThatMagnifyWhatLiesBehindAreFilled) {
    for (const test::LensKind& kind :
         {test::LensKind{"Stereographic", {RadialModel::stereographic}, 359.9},
          test::LensKind{"Curvilinear", {RadialModel::stereographic}, 179.9, true}}) {
        RenderRequest request = warpRequest(test::lensWall(kind, kSizePx), boxRoom({8, 5, 8}), {}, 4);
        request.measuresError = true;
        EXPECT_LT(render(request).stats.geometricError.p99Px, 0.25) << kind.name;
        request.measuresError = false;
        request.output = OutputKind::coverage;
        EXPECT_EQ(coverOf(frameOf(request), request.wall->displays[0]).missing, 0) << kind.name;
    }
}

// Two triangles 1.7 m below the eye, which is not above the edge that they share.
Scene groundTo(float reachM) {
    Scene ground;
    startMaterial(ground, plainMaterial(glm::vec3(1)));
    const float furtherM = 0.9f * reachM;
    addQuad(ground, {glm::vec3(-reachM, -1.7, reachM), glm::vec3(reachM, -1.7, reachM),
                     glm::vec3(reachM, -1.7, -furtherM), glm::vec3(-reachM, -1.7, -furtherM)});
    return ground;
}

// Seen from so close above that its parts differ ten thousand times in size.
TEST_F(VertexWarp, AGroundToTheHorizonFillsWhatLiesBelow) {
    const auto disagreementsOn = [&](const Wall& wall, float reachM) {
        return disagreements(warpRequest(wall, groundTo(reachM)));
    };
    for (const Wall& wall : {test::fullCylinderWall(kSizePx), test::lensWall(kDome, kSizePx),
                             test::lensWall({"Wide", {RadialModel::equisolid}, 300}, kSizePx)}) {
        EXPECT_LE(disagreementsOn(wall, 5000), 30) << wall.name;
    }
    // These show the pole below, and one on the horizon.
    for (const std::string name : {"equirectangular", "sphere-slices"}) {
        EXPECT_LE(disagreementsOn(test::smallShippedWall(name, 4), 10'000), 30) << name;
    }
}

// How fine its parts are is a matter of the corners nearby, not of those far away. What rays in single
// precision would meet is no truth here.
TEST_F(VertexWarp, AStripFromBesideTheEyeMayGoFarAway) {
    constexpr float kLeftM = -1, kRightM = 0.6f, kBelowM = 1.7f, kAheadM = 3;
    const auto isOnStrip = [](glm::dvec3 ray) {
        const glm::dvec3 pointM = ray * (kBelowM / -ray.y);
        return ray.y < 0 && pointM.x > kLeftM && pointM.x < kRightM && pointM.z > -kAheadM;
    };
    for (const float behindM : {1e5f, 1e7f, 1e10f}) {
        Scene strip;
        startMaterial(strip, plainMaterial(glm::vec3(1)));
        addQuad(strip, {glm::vec3(kLeftM, -kBelowM, behindM), glm::vec3(kRightM, -kBelowM, behindM),
                        glm::vec3(kRightM, -kBelowM, -kAheadM), glm::vec3(kLeftM, -kBelowM, -kAheadM)});
        for (const Wall& wall : {test::fullCylinderWall(kSizePx), test::lensWall(kDome, kSizePx)}) {
            RenderRequest request = warpRequest(wall, strip);
            request.output = OutputKind::coverage;
            const Frame frame = frameOf(request);
            int differ = 0;
            for (int y = 0; y < kSizePx.y; ++y)
                for (int x = 0; x < kSizePx.x; ++x) {
                    const auto ray = wall.displays[0].projection->unproject(centreOf({x, y}));
                    differ += (ray && isOnStrip(*ray)) != (*frame.at(x, y) > 0);
                }
            EXPECT_LE(differ, 30) << behindM << " " << wall.name;
        }
    }
}

// Points are known to a ten-millionth of the distances of corners all around. A cylinder does not show what
// lies below.
TEST_F(VertexWarp, RefusesToLeaveOpenWhatNeedsFinerPartsThanThereAre) {
    const auto expectRefusal = [&](const RenderRequest& request) {
        try {
            frameOf(request);
            ADD_FAILURE() << "draws a gap";
        } catch (const UsageError& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr("would stay open"));
        }
    };
    for (const float reachM : {1e6f, 1e10f})
        expectRefusal(warpRequest(test::smallShippedWall("equirectangular", 4), groundTo(reachM)));
    const test::LensKind lens{"Stereographic", {RadialModel::stereographic}, 359.9999};
    expectRefusal(warpRequest(test::lensWall(lens, kSizePx), boxRoom({8, 5, 8})));
    EXPECT_LE(disagreements(warpRequest(test::fullCylinderWall(kSizePx), groundTo(1e6f))), 30);
}

// What is opaque and what blends are divided apart, and both are refused.
TEST_F(VertexWarp, AFrameThatIsRefusedLeavesNothingBehindForTheNext) {
    constexpr float kReachM = 1e6f;
    Scene ground = groundTo(kReachM);
    Material glass = plainMaterial(glm::vec3(0.5f));
    glass.blending = Blending::alpha;
    glass.baseColor.a = 0.5f;
    startMaterial(ground, glass);
    addQuad(ground, {glm::vec3(-kReachM, -1.6, kReachM), glm::vec3(kReachM, -1.6, kReachM),
                     glm::vec3(kReachM, -1.6, -kReachM), glm::vec3(-kReachM, -1.6, -kReachM)});
    const RenderRequest near = warpRequest(test::smallShippedWall("equirectangular", 4), ground);
    RenderRequest fromAbove = near;
    fromAbove.camera.positionM.y = kReachM;
    const Frame expected = Renderer().render(fromAbove).frame;
    EXPECT_THROW(frameOf(near), UsageError);
    EXPECT_EQ(frameOf(fromAbove).texels, expected.texels);
}

TEST_F(VertexWarp, WhatLiesBehindTheEyeIsNotShown) {
    Scene behind;
    startMaterial(behind, plainMaterial(glm::vec3(1)));
    addQuad(behind, {glm::vec3(1, -1, 2), glm::vec3(-1, -1, 2), glm::vec3(-1, 1, 2), glm::vec3(1, 1, 2)});
    for (const Wall& wall : {test::planarWall(kSizePx, 90), test::lensWall(kDome, kSizePx),
                             test::lensWall({"Curvilinear80", {}, 80, true}, kSizePx)}) {
        RenderRequest request = warpRequest(wall, behind);
        request.output = OutputKind::coverage;
        for (const double tessellationPx : {0.0, 8.0}) {
            request.tessellationPx = tessellationPx;
            EXPECT_EQ(std::ranges::max(frameOf(request).texels), 0) << wall.name << " " << tessellationPx;
        }
    }
}

TEST_F(VertexWarp, WhatCrossesTheSeamIsShownAtBothBorders) {
    Scene behind;
    startMaterial(behind, plainMaterial(glm::vec3(1)));
    addQuad(behind, {glm::vec3(1, -1, 2), glm::vec3(-1, -1, 2), glm::vec3(-1, 1, 2), glm::vec3(1, 1, 2)});
    RenderRequest request = warpRequest(test::fullCylinderWall(kSizePx), behind);
    EXPECT_LE(disagreements(request), 4);
    request.output = OutputKind::coverage;
    const Frame frame = frameOf(request);
    const int middle = kSizePx.y / 2;
    EXPECT_EQ(*frame.at(0, middle), 1);
    EXPECT_EQ(*frame.at(kSizePx.x - 1, middle), 1);
    EXPECT_EQ(*frame.at(kSizePx.x / 2, middle), 0);
}

TEST_F(VertexWarp, DepthIsTheDistanceToThePosition) {
    RenderRequest request = warpRequest(test::lensWall(kDome, kSizePx, test::kTurned), loadScene("city:2000"),
                                        {{0, 8, 0}, {}}, 4);
    request.output = OutputKind::position;
    const Frame position = frameOf(request);
    request.output = OutputKind::depth;
    const Frame depth = frameOf(request);
    for (size_t i = 0; i < depth.texels.size(); ++i) {
        const glm::vec3 shown(position.texels[3 * i], position.texels[3 * i + 1], position.texels[3 * i + 2]);
        ASSERT_EQ(std::isnan(shown.x), std::isinf(depth.texels[i]));
        if (!std::isnan(shown.x)) {
            ASSERT_NEAR(depth.texels[i], glm::length(shown), 1e-5 * glm::length(shown));
        }
    }
}

TEST_F(VertexWarp, LineStylesAgreeWithTheReference) {
    for (const Style style : {Style::wireframe, Style::penAndInk, Style::unlit})
        for (const Wall& wall :
             {test::fullCylinderWall({400, 300}), test::lensWall(kDome, {400, 400}, test::kTurned)}) {
            RenderRequest request =
                warpRequest(wall, boxRoom({8, 5, 8}), {{1, 0.5, -0.7}, {0.3, 0.1, 0.2}}, 4);
            request.style = style;
            EXPECT_LT(shareOff(request), 0.004) << wall.name;
        }
}

TEST_F(VertexWarp, MoreSamplesComeNearerToTheConvergedPicture) {
    const std::vector<double> psnrDb = test::psnrDbOfMoreSamples(
        renderer_,
        warpRequest(test::lensWall(kDome, kSizePx), loadScene("city:2000"), {{0, 8, 0}, {0.3, 0, 0}}, 4));
    EXPECT_GT(psnrDb[1], psnrDb[0] + 2);
    EXPECT_GT(psnrDb[2], psnrDb[1] + 2);
}

TEST_F(VertexWarp, SurfacesMixFarToNear) {
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
    for (const Wall& wall : {test::fullCylinderWall(kSizePx), test::lensWall(kDome, kSizePx)}) {
        RenderRequest request = warpRequest(wall, scene, {}, 4);
        request.style = Style::unlit;
        EXPECT_LT(shareOff(request), 0.003) << wall.name;
    }
}

TEST_F(VertexWarp, TrianglesSeenFromBehindAreDrawnOnlyWhenTheirMaterialIsDoubleSided) {
    for (const bool doubleSided : {true, false}) {
        Scene scene;
        Material material = plainMaterial({0.9, 0.5, 0.1});
        material.doubleSided = doubleSided;
        startMaterial(scene, material);
        addFrontalSquare(scene, {0, 0, -3}, 3);
        addQuad(scene, {glm::vec3(2, -1, -1), glm::vec3(2, -1, 1), glm::vec3(2, 1, 1), glm::vec3(2, 1, -1)});
        EXPECT_LT(shareOff(warpRequest(test::lensWall(kDome, kSizePx), scene, {}, 4)), 0.001) << doubleSided;
    }
}

TEST_F(VertexWarp, ScenesFarFromTheOriginRenderLikeThoseBesideIt) {
    RenderRequest request =
        warpRequest(test::fullCylinderWall(kSizePx), loadScene("city:2000"), {{0, 8, 0}, {}});
    const Frame beside = frameOf(request);
    const glm::dvec3 farM(1e6, -2e5, 3e6);
    Scene moved = *request.scene;
    moved.originM += farM;
    request.scene = std::make_shared<const Scene>(std::move(moved));
    request.camera.positionM += farM;
    EXPECT_EQ(compareColor(frameOf(request), beside).shareOff, 0);
}

TEST_F(VertexWarp, TheSameRequestGivesTheSameBytes) {
    const RenderRequest request =
        warpRequest(test::fullCylinderWall(kSizePx), loadScene("city:2000"), {{0, 8, 0}, {}});
    const Frame first = frameOf(request);
    EXPECT_EQ(Renderer().render(request).frame.texels, first.texels);
}

TEST_F(VertexWarp, StatsTellPartsLengthAndError) {
    RenderRequest request = warpRequest(test::fullCylinderWall(kSizePx), loadScene("room"), {}, 4);
    request.measuresError = true;
    const RenderStats stats = render(request).stats;
    EXPECT_EQ(stats.method, "vertex-warp");
    EXPECT_EQ(stats.engine, "tessellation");
    EXPECT_EQ(stats.tessellationPx, 4);
    EXPECT_GT(stats.pairs, 12u);
    EXPECT_GT(stats.geometricError.maxPx, stats.geometricError.meanPx);
    EXPECT_GT(stats.geometricError.meanPx, 0);
    request.tessellationPx = 0;
    request.measuresError = false;
    const RenderStats undivided = render(request).stats;
    EXPECT_EQ(undivided.engine, "vertex");
    EXPECT_LT(undivided.pairs, stats.pairs);
    EXPECT_EQ(undivided.geometricError.maxPx, 0);
}

TEST_F(VertexWarp, RefusesPointsAndLines) {
    Scene scene = boxRoom({8, 5, 8});
    addLines(scene, plainMaterial(glm::vec3(1)), {{glm::vec3(-1, 0, -2), glm::vec3(1, 0, -2)}});
    try {
        frameOf(warpRequest(test::fullCylinderWall(kSizePx), scene));
        FAIL() << "draws lines";
    } catch (const UsageError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("no points and lines"));
    }
}

TEST_F(VertexWarp, RefusesLengthsThatATriangleHasTooManyPartsFor) {
    RenderRequest request = warpRequest(test::shippedWall("equirectangular"), boxRoom({8, 5, 8}), {}, 0.3);
    EXPECT_THROW(frameOf(request), UsageError);
    // What it left behind does not reach the next frame.
    request.tessellationPx = 8;
    request.output = OutputKind::coverage;
    EXPECT_EQ(coverOf(frameOf(request), request.wall->displays[0]).missing, 0);
}

}  // namespace
}  // namespace curvewall
