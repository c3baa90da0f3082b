#include "renderer/reference.h"

#include "calibration/errors.h"
#include "renderer/image_file.h"
#include "renderer/shading.h"
#include "tests/support/rendering.h"
#include "tests/support/test_projections.h"
#include "tests/support/test_scenes.h"
#include "tests/support/test_walls.h"

#include <glm/gtc/constants.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace curvewall {
namespace {

using Options = ReferenceRenderer::Options;

constexpr Options kColor{Style::unlit, OutputKind::color};
constexpr Options kDepth{Style::unlit, OutputKind::depth};
constexpr Options kPosition{Style::unlit, OutputKind::position};
constexpr Options kCoverage{Style::unlit, OutputKind::coverage};

Frame render(const Scene& scene, const Wall& wall, const Options& options, const Camera& camera = {}) {
    return ReferenceRenderer(std::make_shared<const Scene>(scene))
        .render(wall, wall.displays.front(), camera, options);
}

glm::vec3 rgb(const Frame& frame, int x, int y) {
    const float* texel = frame.at(x, y);
    return {texel[0], texel[1], texel[2]};
}

struct BoxHit {
    double distance;
    size_t wall;  // index into kBoxRoomColors
};

// From inside, the nearest of the six planes.
BoxHit boxHit(glm::dvec3 sizeM, glm::dvec3 eye, glm::dvec3 direction) {
    BoxHit hit{std::numeric_limits<double>::infinity(), 0};
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0) continue;
        const bool positive = direction[axis] > 0;
        const double distance = ((positive ? 0.5 : -0.5) * sizeM[axis] - eye[axis]) / direction[axis];
        if (distance < hit.distance) hit = {distance, static_cast<size_t>(2 * axis + positive)};
    }
    return hit;
}

class Seeded {
public:
    explicit Seeded(uint32_t seed) : random_(seed) {}
    double between(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
    glm::dvec3 inBox(glm::dvec3 sizeM) {
        return sizeM * glm::dvec3(between(-0.5, 0.5), between(-0.5, 0.5), between(-0.5, 0.5));
    }
    Camera camera(glm::dvec3 roomM) {
        return {inBox(roomM), {between(-4, 4), between(-1.5, 1.5), between(-4, 4)}};
    }

private:
    std::mt19937 random_;
};

TEST(Reference, RoomAgreesWithItsPlanes) {
    const glm::dvec3 sizeM{8, 5, 6};
    const Scene room = boxRoom(sizeM);
    Seeded seeded(1);
    for (int view = 0; view < 20; ++view) {
        Wall wall = pinholeWall({40, 30}, seeded.between(5, 40), seeded.between(0.1, 4));
        wall.eyeM = seeded.inBox(glm::dvec3(0.5));
        const Camera camera = seeded.camera(0.8 * sizeM);
        const glm::dmat3 sceneFromWall = rotationFromOrientation(camera.orientation);
        const glm::dvec3 eye = camera.positionM + sceneFromWall * wall.eyeM;
        const Frame color = render(room, wall, kColor, camera), depth = render(room, wall, kDepth, camera),
                    position = render(room, wall, kPosition, camera);
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x) {
                const glm::dvec3 ray =
                    glm::normalize(*wall.displays[0].projection->unproject({x + 0.5, y + 0.5}));
                const BoxHit hit = boxHit(sizeM, eye, sceneFromWall * ray);
                EXPECT_NEAR(*depth.at(x, y), hit.distance, 2e-6 * hit.distance);
                EXPECT_LT(glm::length(glm::dvec3(rgb(position, x, y)) - hit.distance * ray),
                          2e-6 * hit.distance);
                EXPECT_EQ(rgb(color, x, y), kBoxRoomColors[hit.wall]);
            }
    }
}

TEST(Reference, AThousandKilometresAwayNothingChanges) {
    const Scene here = boxRoom({8, 5, 6});
    Scene there = here;
    there.originM = {1e6, -3e5, 7e5};
    const Wall wall = pinholeWall({40, 30}, 20);
    Seeded seeded(2);
    for (int view = 0; view < 5; ++view) {
        const Camera camera = seeded.camera({6, 4, 5});
        const Camera moved{camera.positionM + there.originM, camera.orientation};
        const Frame a = render(here, wall, kDepth, camera), b = render(there, wall, kDepth, moved);
        EXPECT_THAT(b.texels, testing::Pointwise(testing::FloatNear(1e-4f), a.texels));
    }
}

// Embree traces floats; the distance is exact all the same.
TEST(Reference, EyesBeyondAnyNumberOfUseAreRefused) {
    RenderRequest request = test::requestFor(test::planarWall({8, 8}, 90), boxRoom({8, 5, 6}));
    for (const double farM : {1e19, 1e200}) {
        request.camera.positionM.x = farM;
        EXPECT_THROW(test::referenceOf(request), UsageError);
    }
    request.camera.positionM.x = 1e14;
    EXPECT_NO_THROW(test::referenceOf(request));
}

TEST(Reference, AKilometreFromTheOriginDistancesStayExact) {
    Scene scene;
    startMaterial(scene, plainMaterial(glm::vec3(1)));
    addFrontalSquare(scene, {1000, 1000, 1000}, 64);
    const Camera camera{{1000.123456789, 999.87654321, 1003.333333333}, {}};
    EXPECT_FLOAT_EQ(*render(scene, pinholeWall({1, 1}, 1), kDepth, camera).at(0, 0), 3.333333333f);
}

TEST(Reference, AClosedBoxHasNoCracks) {
    const glm::dvec3 sizeM{7.7, 4.9, 8.3};
    const ReferenceRenderer renderer(std::make_shared<const Scene>(boxRoom(sizeM)));
    const glm::dvec3 half = glm::dvec3(glm::vec3(sizeM) / 2.0f);
    Seeded seeded(3);
    for (int view = 0; view < 10; ++view) {
        const Camera camera{seeded.inBox(0.98 * sizeM), {}};
        // A third each to corners, to edges, and to the diagonals that split the walls.
        std::vector<std::optional<glm::dvec3>> rays;
        rays.reserve(10000);
        for (int i = 0; i < 10000; ++i) {
            glm::dvec3 target = half * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
            const int axis = i % 5 % 3;
            const double along = seeded.between(-1, 1);
            if (i % 3 != 0) target[axis] = along * half[axis];
            if (i % 3 == 1) target[(axis + 1) % 3] = (i & 8 ? 1 : -1) * along * half[(axis + 1) % 3];
            rays.emplace_back(target - camera.positionM);
        }
        const Wall wall = wallOf(std::make_shared<RayListProjection>(100, rays), {100, 100});
        const Frame depth = renderer.render(wall, wall.displays[0], camera, kDepth);
        for (size_t i = 0; i < rays.size(); ++i)
            EXPECT_NEAR(depth.texels[i], glm::length(*rays[i]), 1e-5 * glm::length(*rays[i]));
    }
}

TEST(Reference, WhereNothingIsDrawnTheFrameSaysSo) {
    Scene scene;
    startMaterial(scene, plainMaterial(glm::vec3(1)));
    addFrontalSquare(scene, {0, 0, -1}, 1);
    // A hit, a ray into the void, and a hole in the display.
    Wall wall = wallOf(std::make_shared<RayListProjection>(
                           3, std::vector<std::optional<glm::dvec3>>{glm::dvec3(0, 0, -1),
                                                                     glm::dvec3(0, 0, 1), std::nullopt}),
                       {3, 1});
    wall.background = {0.1f, 0.2f, 0.3f};
    const Frame color = render(scene, wall, kColor), depth = render(scene, wall, kDepth),
                position = render(scene, wall, kPosition), coverage = render(scene, wall, kCoverage);
    EXPECT_EQ(rgb(color, 0, 0), glm::vec3(1));
    EXPECT_EQ(*depth.at(0, 0), 1);
    EXPECT_EQ(rgb(position, 0, 0), glm::vec3(0, 0, -1));
    EXPECT_EQ(*coverage.at(0, 0), 1);
    for (int x = 1; x < 3; ++x) {
        EXPECT_EQ(rgb(color, x, 0), wall.background);
        EXPECT_EQ(*depth.at(x, 0), std::numeric_limits<float>::infinity());
        for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isnan(position.at(x, 0)[c]));
        EXPECT_EQ(*coverage.at(x, 0), 0);
    }
    EXPECT_EQ(rgb(render(Scene{}, wall, kColor), 0, 0), wall.background);
}

TEST(Reference, WhatIsNearerThanAShareOfTheWallIsCut) {
    Scene scene;
    startMaterial(scene, plainMaterial({1, 0, 0}));
    addFrontalSquare(scene, {0, 0, -1e-4f}, 1);
    startMaterial(scene, plainMaterial({0, 1, 0}));
    addFrontalSquare(scene, {0, 0, -5}, 1);
    EXPECT_EQ(rgb(render(scene, pinholeWall({1, 1}, 1, 9), kColor), 0, 0), glm::vec3(1, 0, 0));
    EXPECT_EQ(rgb(render(scene, pinholeWall({1, 1}, 1, 11), kColor), 0, 0), glm::vec3(0, 1, 0));
    EXPECT_EQ(*render(scene, pinholeWall({1, 1}, 1, 11), kCoverage).at(0, 0), 1);
}

// The left half of the front square is transparent; what is behind shows there.
TEST(Reference, MaskedTexelsShowWhatIsBehind) {
    Scene scene;
    Material masked =
        texturedMaterial(scene, squareTexture(64, [](int, int size) {
                             std::vector<glm::u8vec4> texels;
                             for (int i = 0; i < size * size; ++i)
                                 texels.emplace_back(255, 0, 0, 2 * (i % size) < size ? 0 : 255);
                             return texels;
                         }));
    masked.texture = 0;
    masked.alphaCutoff = 0.5f;
    startMaterial(scene, masked);
    addFrontalSquare(scene, {0, 0, -1}, 2);
    startMaterial(scene, plainMaterial({0, 0, 1}));
    addFrontalSquare(scene, {0, 0, -3}, 8);

    const Wall wall = pinholeWall({32, 32}, 16);
    const Frame color = render(scene, wall, kColor), depth = render(scene, wall, kDepth),
                coverage = render(scene, wall, kCoverage);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            EXPECT_EQ(rgb(color, x, y), x < 16 ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0)) << x;
            EXPECT_EQ(*coverage.at(x, y), x < 16 ? 1 : 2);
            EXPECT_EQ(*depth.at(x, y) > 2.9f, x < 16);
        }
    // The factor's alpha counts too: all of it is below the cutoff.
    scene.materials[0].baseColor.a = 0.4f;
    EXPECT_EQ(rgb(render(scene, wall, kColor), 31, 0), glm::vec3(0, 0, 1));
}

Material blendedMaterial(glm::vec4 color, Blending blending) {
    Material material = plainMaterial(glm::vec3(color));
    material.baseColor.a = color.a;
    material.blending = blending;
    return material;
}

struct Pane {
    float z;
    glm::vec4 color;
    Blending blending = Blending::alpha;
};

// Squares one behind the other, in this order in the scene, with a diagonal through every pixel on it.
Scene panes(const std::vector<Pane>& order) {
    Scene scene;
    for (const Pane& pane : order) {
        startMaterial(scene, blendedMaterial(pane.color, pane.blending));
        addFrontalSquare(scene, {0, 0, pane.z}, -2 * pane.z);
    }
    return scene;
}

const Pane kNearPane{-1, {1, 0.2f, 0, 0.25f}}, kMiddlePane{-2, {0, 1, 0.4f, 0.5f}},
    kFarPane{-3, {0.1f, 0, 1, 0.75f}};

void expectColor(const Frame& frame, glm::vec3 expected) {
    for (int y = 0; y < frame.sizePx.y; ++y)
        for (int x = 0; x < frame.sizePx.x; ++x)
            EXPECT_LT(glm::length(rgb(frame, x, y) - expected), 1e-6f) << x << ' ' << y;
}

// Sixteen by sixteen pixels whose diagonal is that of the squares: it must not show.
TEST(Reference, TransparentSurfacesMixFromFarToNear) {
    Wall wall = pinholeWall({16, 16}, 8);
    wall.background = {0.5f, 0.25f, 0.125f};
    glm::vec3 expected = wall.background;
    for (const Pane& pane : {kFarPane, kMiddlePane, kNearPane})
        expected = pane.color.a * glm::vec3(pane.color) + (1 - pane.color.a) * expected;
    std::vector<Pane> order{kNearPane, kMiddlePane, kFarPane};
    const auto before = [](const Pane& a, const Pane& b) { return a.z < b.z; };
    std::ranges::sort(order, before);
    do {
        expectColor(render(panes(order), wall, kColor), expected);
    } while (std::ranges::next_permutation(order, before).found);
}

TEST(Reference, AdditiveSurfacesAddAndHideNothing) {
    Wall wall = pinholeWall({16, 16}, 8);
    wall.background = glm::vec3(0.1f);
    const Pane light{-1.5f, {0.5f, 2, 1, 0.5f}, Blending::additive};
    const auto added = [](const Pane& pane) { return pane.color.a * glm::vec3(pane.color); };
    Pane other = light;
    other.z = -2.5f;
    expectColor(render(panes({light, other}), wall, kColor), wall.background + 2.0f * added(light));
    // What is nearer dims the light, and the light lets through what is farther.
    const glm::vec3 middle = added(kMiddlePane) + (1 - kMiddlePane.color.a) * wall.background;
    expectColor(render(panes({kMiddlePane, light, kNearPane}), wall, kColor),
                added(kNearPane) + (1 - kNearPane.color.a) * (added(light) + middle));
}

TEST(Reference, WhatIsBehindASolidSurfaceDoesNotMix) {
    const Wall wall = pinholeWall({16, 16}, 8);
    const Pane solid{-2.5f, {0.3f, 0.6f, 0.9f, 0.5f}, Blending::none};
    expectColor(render(panes({kFarPane, solid}), wall, kColor), glm::vec3(solid.color));
    const Scene scene = panes({kNearPane, kFarPane, solid});
    expectColor(render(scene, wall, kColor),
                0.25f * glm::vec3(kNearPane.color) + 0.75f * glm::vec3(solid.color));
    EXPECT_EQ(rgb(render(scene, wall, kPosition), 5, 5).z, -2.5f);
    EXPECT_THAT(render(scene, wall, kCoverage).texels, testing::Each(3));
}

TEST(Reference, DepthIsThatOfTheNearestSolidSurface) {
    const Wall wall = pinholeWall({16, 16}, 8);
    EXPECT_EQ(*render(panes({kNearPane}), wall, kDepth).at(3, 3), std::numeric_limits<float>::infinity());
    EXPECT_TRUE(std::isnan(*render(panes({kNearPane}), wall, kPosition).at(3, 3)));
}

TEST(Reference, TransparentSurfacesMayBeSingleSided) {
    const Wall wall = pinholeWall({16, 16}, 8);
    Scene scene = panes({kNearPane});
    scene.materials[0].doubleSided = false;
    expectColor(render(scene, wall, kColor), 0.25f * glm::vec3(kNearPane.color));
    for (glm::uvec3& triangle : scene.triangles) std::swap(triangle.y, triangle.z);
    expectColor(render(scene, wall, kColor), wall.background);
}

TEST(Reference, SingleSidedTrianglesCannotBeSeenFromBehind) {
    const Wall wall = pinholeWall({1, 1}, 1);
    const auto sceneWith = [](bool doubleSided, bool turned) {
        Scene scene;
        Material material = plainMaterial({0, 1, 0});
        material.doubleSided = doubleSided;
        startMaterial(scene, material);
        const glm::vec3 a(-1, -1, -2), b(1, -1, -2), c(0, 1, -2);
        addTriangle(scene, turned ? std::array{b, a, c} : std::array{a, b, c});
        return scene;
    };
    EXPECT_EQ(rgb(render(sceneWith(false, false), wall, kColor), 0, 0), glm::vec3(0, 1, 0));
    EXPECT_EQ(rgb(render(sceneWith(false, true), wall, kColor), 0, 0), wall.background);
    EXPECT_EQ(rgb(render(sceneWith(true, true), wall, kColor), 0, 0), glm::vec3(0, 1, 0));
    EXPECT_EQ(*render(sceneWith(false, true), wall, kCoverage).at(0, 0), 0);
    EXPECT_EQ(*render(sceneWith(true, true), wall, kCoverage).at(0, 0), 1);
}

// Pixel centres lie exactly on the diagonals that split the walls; they are covered once all the same.
TEST(Reference, CoverageCountsEachCrossingOnce) {
    const Wall wall = pinholeWall({64, 64}, 32);
    Scene room = boxRoom(glm::vec3(4));
    for (const float texel : render(room, wall, kCoverage).texels) EXPECT_EQ(texel, 1);

    const Frame outside = render(room, wall, kCoverage, {{0, 0, 40}, {}});
    EXPECT_EQ(*outside.at(32, 32), 2);
    EXPECT_EQ(*outside.at(0, 0), 0);
    EXPECT_THAT(outside.texels, testing::Each(testing::AnyOf(0, 2)));

    // Of walls seen from behind, nothing is left to count.
    for (Material& material : room.materials) material.doubleSided = false;
    EXPECT_EQ(*render(room, wall, kCoverage, {{0, 0, 40}, {}}).at(32, 32), 1);

    // Two surfaces in one place are two.
    Scene twice;
    startMaterial(twice, plainMaterial(glm::vec3(1)));
    addFrontalSquare(twice, {0.1f, 0.2f, -1}, 4);
    addFrontalSquare(twice, {0.1f, 0.2f, -1}, 4);
    EXPECT_EQ(*render(twice, wall, kCoverage).at(7, 7), 2);
}

TEST(Reference, SurfacesAreLitByTheirNormalTurnedToTheEye) {
    const Wall wall = pinholeWall({1, 1}, 1);
    const glm::vec3 tilted = glm::normalize(glm::vec3(0.3f, 0.5f, 0.8f)), color(0.5f, 0.25f, 1);
    Scene scene;
    startMaterial(scene, plainMaterial(color));
    addFrontalSquare(scene, {0, 0, -2}, 1);
    for (glm::vec3& normal : scene.normals) normal = tilted;
    const auto seen = [&](const Camera& camera) {
        return rgb(render(scene, wall, {Style::textured, OutputKind::color}, camera), 0, 0);
    };
    const auto expectNear = [](glm::vec3 a, glm::vec3 b) { EXPECT_LT(glm::length(a - b), 1e-6f); };
    const Camera behind{{0, 0, -4}, {glm::pi<double>(), 0, 0}};
    expectNear(seen({}), color * shading::lightOnSurface(tilted));
    expectNear(seen(behind), color * shading::lightOnSurface(-tilted));
    // The light stays with the scene when the wall rolls.
    expectNear(seen({{}, {0, 0, 1}}), color * shading::lightOnSurface(tilted));
    scene.materials[0].unlit = true;
    EXPECT_EQ(seen({}), color);
}

TEST(Reference, NormalsAreInterpolatedAndNormalised) {
    Scene scene;
    startMaterial(scene, plainMaterial(glm::vec3(1)));
    addTriangle(scene, {glm::vec3(-1, -1, -2), glm::vec3(1, -1, -2), glm::vec3(0, 2, -2)});
    const glm::vec3 a(0.8f, 0, 0.6f), b(-0.6f, 0, 0.8f), c(0, 0.6f, 0.8f);
    scene.normals = {a, b, c};
    // The ray along -z meets the weights 1/3, 1/3, 1/3.
    const glm::vec3 expected = shading::lightOnSurface(glm::normalize(a + b + c));
    const Frame frame = render(scene, pinholeWall({1, 1}, 1), {Style::textured, OutputKind::color});
    EXPECT_LT(glm::length(rgb(frame, 0, 0) - expected), 1e-6f);
}

Texture checkerboard(int sizePx) {
    return squareTexture(sizePx, [](int level, int size) {
        std::vector<glm::u8vec4> texels;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const uint8_t grey = level > 0 ? 188 : (x + y) % 2 == 0 ? 0 : 255;
                texels.emplace_back(grey, grey, grey, 255);
            }
        return texels;
    });
}

TEST(Reference, ACheckerboardIsSharpNearAndGreyFar) {
    Scene scene;
    startMaterial(scene, texturedMaterial(scene, checkerboard(8)));
    addFrontalSquare(scene, {0, 0, -1}, 2);
    // Eight pixels a texel: the texel's centre is a corner of pixels, so look at the four around it.
    const Frame near = render(scene, pinholeWall({64, 64}, 32), kColor);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) {
            const bool white = (x + y) % 2 == 1;
            const float centre = (near.at(8 * x + 3, 8 * y + 3)[0] + near.at(8 * x + 4, 8 * y + 4)[0]) / 2;
            // Bilinear, half a pixel of eight from the texel's centre both ways.
            const bool atBorder = x == 0 || y == 0 || x == 7 || y == 7;
            EXPECT_NEAR(centre, white ? 1 : 0, atBorder ? 0.125 : 0.12);
        }
    // One pixel a texel: exactly the texels.
    const Frame exact = render(scene, pinholeWall({8, 8}, 4), kColor);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) EXPECT_NEAR(exact.at(x, y)[0], (x + y) % 2, 1e-6);
    // Sixteen texels a pixel.
    Scene wide;
    startMaterial(wide, texturedMaterial(wide, checkerboard(8)));
    addFrontalSquare(wide, {0, 0, -1}, 16, 8);
    const Frame far = render(wide, pinholeWall({2, 2}, 0.25), kColor);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) EXPECT_EQ(srgbByteFromLinear(far.at(x, y)[0]), 188);
}

// Levels alternate between black and white, so that the grey seen tells where between two levels the sample
// lies.
double sampledLevel(float grey, double expectedLevel) {
    const double floor = std::floor(expectedLevel);
    return floor + (static_cast<int>(floor) % 2 == 0 ? grey : 1 - grey);
}

Scene levelsWall(float sideM) {
    Scene scene;
    startMaterial(scene, texturedMaterial(scene, levelsTexture(256, {0, 255, 0, 255, 0, 255, 0, 255, 0})));
    addFrontalSquare(scene, {0, 0, -2}, sideM);
    return scene;
}

// A frontal plane at 2 m has the same footprint everywhere: 2 m / focal length, of sideM / 256 texels.
TEST(Reference, MinificationFollowsTheFootprint) {
    for (const double focalPx : {11.3, 20.0, 28.7, 47.0, 101.0, 200.0})
        for (const int samples : {1, 4, 6, 16}) {
            const Wall wall = pinholeWall({8, 8}, focalPx);
            const double expected = std::log2(2 / focalPx * 256 / 8 / std::sqrt(samples)) + 2;
            Scene scene = levelsWall(2);  // 4 times the texels of an 8 m wall: two levels more
            if (expected < 0 || expected > 8) continue;
            const Frame frame = render(scene, wall, {Style::unlit, OutputKind::color, samples});
            EXPECT_NEAR(sampledLevel(*frame.at(4, 4), expected), expected, 0.01) << focalPx << ' ' << samples;
        }
}

// On a plane at a slant, against the derivative of the plane's uv in closed form.
TEST(Reference, MinificationFollowsTheSlant) {
    Scene floor;
    startMaterial(floor, texturedMaterial(floor, levelsTexture(256, {0, 255, 0, 255, 0, 255, 0, 255, 0})));
    addQuad(floor,
            {glm::vec3(-40, -1, 0), glm::vec3(40, -1, 0), glm::vec3(40, -1, -80), glm::vec3(-40, -1, -80)},
            4);
    const double focalPx = 150, texelsPerM = 256 * 4 / 80.0;
    const Frame frame = render(floor, pinholeWall({8, 64}, focalPx), kColor);
    for (int y = 36; y < 64; ++y) {
        const double down =
            (y + 0.5 - 32) / focalPx;  // tan of the angle below the horizon; the floor is at 1 / down
        const double across = 1 / down / focalPx;
        const double along = 1 / down - 1 / (down + 1 / focalPx);
        const double expected = std::log2(texelsPerM * std::max(across, along));
        if (expected < 0) continue;
        EXPECT_NEAR(sampledLevel(*frame.at(4, y), expected), expected, 0.02) << y;
    }
}

// The ray below the last one that meets a ceiling passes under its horizon: the footprint has no end.
TEST(Reference, TheHorizonIsFilteredByTheCoarsestLevel) {
    Scene ceiling;
    startMaterial(ceiling, texturedMaterial(ceiling, levelsTexture(256, {0, 0, 0, 0, 0, 0, 0, 0, 255})));
    addQuad(ceiling,
            {glm::vec3(-1e4f, 1, 0), glm::vec3(1e4f, 1, 0), glm::vec3(1e4f, 1, -2e4f),
             glm::vec3(-1e4f, 1, -2e4f)},
            100);
    const Frame frame = render(ceiling, pinholeWall({2, 64}, 150), kColor);
    EXPECT_EQ(*frame.at(0, 31), 1);
    EXPECT_EQ(*frame.at(0, 20), 0);
}

// Where a display ends, the footprint is taken from the pixel on the other side.
TEST(Reference, TheLastPixelIsFilteredLikeItsNeighbours) {
    std::vector<std::optional<glm::dvec3>> rays;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) rays.emplace_back(glm::dvec3(0.01 * (x - 1), 0.01 * (1 - y), -1));
    const Wall wall = wallOf(std::make_shared<RayListProjection>(3, rays), {3, 3});
    const Frame frame = render(levelsWall(1), wall, kColor);
    for (const float texel : frame.texels) EXPECT_NEAR(texel, frame.texels.front(), 1e-4);
    EXPECT_NEAR(sampledLevel(*frame.at(2, 2), 2.36), std::log2(0.02 * 256), 0.01);
}

// Area of the part of the unit square at `corner` where dot(normal, p) > offset, by exact scanlines.
double halfPlaneCoverage(glm::dvec2 corner, glm::dvec2 normal, double offset) {
    double area = 0;
    constexpr int kLines = 2000;
    for (int i = 0; i < kLines; ++i) {
        const double y = corner.y + (i + 0.5) / kLines;
        const double edge = (offset - normal.y * y) / normal.x - corner.x;
        area += std::clamp(normal.x > 0 ? 1 - edge : edge, 0.0, 1.0) / kLines;
    }
    return area;
}

TEST(Reference, ManySamplesConvergeToTheAreaOfAnEdge) {
    const Wall wall = pinholeWall({32, 32}, 16);
    for (const int samples : {64, 60}) {
        Seeded seeded(4);
        double meanError = 0, squares = 0;
        int edgePixels = 0;
        for (int edge = 0; edge < 10; ++edge) {
            const double angle = seeded.between(0.2, 1.3);
            const glm::dvec2 normal(std::cos(angle), std::sin(angle));
            const double offset =
                glm::dot(normal, glm::dvec2(seeded.between(12, 20), seeded.between(12, 20)));
            // A triangle with one edge on the line dot(normal, px) = offset; the screen is at z = -1.
            const auto scenePoint = [&](double along, double across) {
                const glm::dvec2 px = normal * (offset + across) + glm::dvec2(-normal.y, normal.x) * along;
                return glm::vec3((px.x - 16) / 16, -(px.y - 16) / 16, -1);
            };
            Scene scene;
            startMaterial(scene, plainMaterial(glm::vec3(1)));
            addTriangle(scene, {scenePoint(-300, 0), scenePoint(300, 0), scenePoint(0, 300)});
            const Frame frame = render(scene, wall, {Style::unlit, OutputKind::color, samples});
            for (int y = 0; y < 32; ++y)
                for (int x = 0; x < 32; ++x) {
                    const double area = halfPlaneCoverage({x, y}, normal, offset);
                    const double error = *frame.at(x, y) - area;
                    if (area <= 0 || area >= 1) {
                        EXPECT_NEAR(error, 0, 1e-6);
                        continue;
                    }
                    meanError += error;
                    squares += error * error;
                    ++edgePixels;
                }
        }
        ASSERT_GT(edgePixels, 200);
        EXPECT_NEAR(meanError / edgePixels, 0, 0.003) << samples;
        // Independent samples would be off by about 0.05, a jittered grid by 0.02.
        EXPECT_LT(std::sqrt(squares / edgePixels), 0.03) << samples;
    }
}

// Black and white average to half the light, not to half the byte.
TEST(Reference, SamplesAverageInLinearLight) {
    Scene scene;
    startMaterial(scene, plainMaterial(glm::vec3(1)));
    addFrontalSquare(scene, {-2, 0, -1}, 4);
    const Frame frame = render(scene, pinholeWall({1, 1}, 1), {Style::unlit, OutputKind::color, 16});
    EXPECT_FLOAT_EQ(*frame.at(0, 0), 0.5f);
}

TEST(Reference, ThePictureDoesNotDependOnTheThreads) {
    const Scene room = boxRoom({8, 5, 6});
    const Wall wall = pinholeWall({50, 40}, 20);
    const Camera camera{{1, 0.5, -1}, {0.3, 0.2, 0.1}};
    for (const int samples : {1, 5, 9}) {
        const Frame one = render(room, wall, {Style::textured, OutputKind::color, samples, 1}, camera);
        for (const int threads : {0, 2, 7, 100})
            EXPECT_EQ(
                render(room, wall, {Style::textured, OutputKind::color, samples, threads}, camera).texels,
                one.texels);
    }
}

class FailingProjection : public PinholeProjection {
public:
    using PinholeProjection::PinholeProjection;
    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override {
        if (px.y > 20) throw std::runtime_error("no ray");
        return PinholeProjection::unproject(px);
    }
};

TEST(Reference, ErrorsInAThreadReachTheCaller) {
    const glm::ivec2 sizePx{32, 32};
    const Wall wall = wallOf(std::make_shared<FailingProjection>(sizePx, 16), sizePx);
    EXPECT_THROW(render(boxRoom(glm::vec3(4)), wall, kColor), std::runtime_error);
    EXPECT_THROW(render(boxRoom(glm::vec3(4)), wall, {Style::unlit, OutputKind::color, 1, 8}),
                 std::runtime_error);
    // Also from within the tracing, where a mask asks for the footprint.
    Scene masked = levelsWall(8);
    masked.materials[0].alphaCutoff = 0.5f;
    const Wall oneRow = wallOf(std::make_shared<FailingProjection>(glm::ivec2(40, 20), 16), {40, 20});
    EXPECT_THROW(render(masked, oneRow, kDepth), std::runtime_error);
}

TEST(Reference, LessThanOneSampleIsImpossible) {
    EXPECT_THROW(render(boxRoom(glm::vec3(4)), pinholeWall({1, 1}, 1), {Style::unlit, OutputKind::color, 0}),
                 UsageError);
}

TEST(Reference, MovesKeepTheScene) {
    const Wall wall = pinholeWall({1, 1}, 1);
    ReferenceRenderer a(std::make_shared<const Scene>(boxRoom(glm::vec3(4))));
    ReferenceRenderer b(std::move(a));
    a = ReferenceRenderer(std::make_shared<const Scene>(boxRoom(glm::vec3(6))));
    EXPECT_EQ(*a.render(wall, wall.displays[0], {}, kDepth).at(0, 0), 3);
    EXPECT_EQ(*b.render(wall, wall.displays[0], {}, kDepth).at(0, 0), 2);
}

}  // namespace
}  // namespace curvewall
