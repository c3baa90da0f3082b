#include "renderer/piecewise.h"

#include "calibration/pieces/ownership.h"
#include "calibration/pieces/piece_fit.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/polygon_meshes.h"
#include "tests/support/random_numbers.h"
#include "tests/support/rendering.h"
#include "tests/support/test_scenes.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

using test::kPi;
constexpr glm::ivec2 kSizePx(800, 600);

class Piecewise : public test::GlTest {
protected:
    Renderer renderer_;
};

Camera cityCamera(double yawDeg = 0) { return {{0, 8, 0}, {yawDeg * kPi / 180, 0, 0}}; }

// Where the full cylinder of test::fullCylinder shows a point, from its definition: the ray from the eye
// meets the wall at the root ahead, x is linear in the angle and y in the height. Written apart from
// calibration/.
glm::dvec2 cylinderPixel(glm::dvec3 eye, glm::dvec3 ray, glm::ivec2 sizePx) {
    const double radius = 2, height = 2 * kPi * radius * sizePx.y / sizePx.x;
    const double a = ray.x * ray.x + ray.z * ray.z, b = 2 * (eye.x * ray.x + eye.z * ray.z);
    const double c = eye.x * eye.x + eye.z * eye.z - radius * radius;
    const glm::dvec3 hit = eye + ray * ((-b + std::sqrt(b * b - 4 * a * c)) / (2 * a));
    return {sizePx.x * (0.5 + std::atan2(hit.x, -hit.z) / (2 * kPi)), sizePx.y * (0.5 - hit.y / height)};
}

// The largest distance of a pixel's centre from the closed-form pixel of the point shown there.
double largestPositionErrorPx(const Frame& positions, glm::dvec3 eye) {
    double largest = 0;
    for (int y = 0; y < positions.sizePx.y; ++y) {
        for (int x = 0; x < positions.sizePx.x; ++x) {
            const float* p = positions.at(x, y);
            if (!std::isfinite(p[0])) continue;
            glm::dvec2 off = glm::abs(cylinderPixel(eye, {p[0], p[1], p[2]}, positions.sizePx) -
                                      glm::dvec2(x + 0.5, y + 0.5));
            off.x = std::min(off.x, positions.sizePx.x - off.x);
            largest = std::max(largest, glm::length(off));
        }
    }
    return largest;
}

TEST_F(Piecewise, CityAgreesWithTheReference) {
    for (double yawDeg : {0.0, 100.0}) {
        const RenderRequest request =
            test::requestFor(test::fullCylinderWall(kSizePx), loadScene("city"), cityCamera(yawDeg));
        const ImageDifference difference = test::differenceFromReference(request);
        // A quarter pixel moves edges: a pixel whose centre lies within that of one may show the other side.
        EXPECT_LT(difference.shareOff, 0.003);
        EXPECT_GT(difference.psnrDb, 35);
        EXPECT_GT(difference.ssim, 0.99);
    }
}

TEST_F(Piecewise, FlatColoursDifferOnlyWithinTheToleranceOfEdges) {
    RenderRequest request = test::requestFor(test::fullCylinderWall(kSizePx), boxRoom({8, 5, 8}),
                                             {{1, 0.5, -0.7}, {0.3, 0.1, 0.2}});
    request.style = Style::unlit;
    double coarser = 1;
    for (double tolerancePx : {2.0, 0.25, 0.01}) {
        request.tolerancePx = tolerancePx;
        const double shareOff = test::differenceFromReference(request).shareOff;
        EXPECT_LT(shareOff, coarser);
        coarser = shareOff;
    }
    EXPECT_LT(coarser, 2e-5);  // about ten of 480,000 pixels
}

TEST_F(Piecewise, UnlitCityAgreesWithTheReference) {
    RenderRequest request =
        test::requestFor(test::fullCylinderWall(kSizePx), loadScene("city"), cityCamera(30));
    request.style = Style::unlit;
    EXPECT_LT(test::differenceFromReference(request).shareOff, 0.003);
}

TEST_F(Piecewise, EveryPixelShowsAPointWithinTheCertifiedError) {
    for (const glm::dvec3 eye : {glm::dvec3(0), glm::dvec3(0.6, 0.4, -0.9), glm::dvec3(1.8, 0, 0)}) {
        for (double tolerancePx : {1.0, 0.25}) {
            RenderRequest request =
                test::requestFor(test::fullCylinderWall(kSizePx, eye), loadScene("city"), cityCamera());
            request.output = OutputKind::position;
            request.tolerancePx = tolerancePx;
            const RenderResult result = renderer_.render(request);
            ASSERT_LE(result.stats.geometricError.maxPx, tolerancePx);
            // OpenGL rasterizes vertices on a grid of 1/256 px, and the positions are interpolated between
            // those.
            EXPECT_LE(largestPositionErrorPx(result.frame, eye),
                      result.stats.geometricError.maxPx + 1.0 / 256);
        }
    }
}

TEST_F(Piecewise, DepthIsTheDistanceToThePosition) {
    RenderRequest request =
        test::requestFor(test::fullCylinderWall({400, 300}), loadScene("city:5000"), cityCamera());
    request.output = OutputKind::depth;
    const Frame depth = renderer_.render(request).frame;
    const Frame expected = test::referenceOf(request).frame;
    int off = 0;
    for (size_t i = 0; i < depth.texels.size(); ++i) {
        const float a = depth.texels[i], b = expected.texels[i];
        off += std::isinf(a) != std::isinf(b) || std::abs(a - b) > 0.01f * b;
    }
    EXPECT_LT(off, 0.01 * 400 * 300);  // silhouettes, within the tolerance
}

TEST_F(Piecewise, AClosedRoomCoversEveryPixelExactlyOnce) {
    // From inside a convex room each ray meets one wall: no pixel is left, none is drawn twice.
    test::Random random(1);
    const ScenePtr room = std::make_shared<const Scene>(loadScene("room"));
    const WallPtr walls[] = {
        std::make_shared<const Wall>(test::fullCylinderWall({1600, 1200})),
        std::make_shared<const Wall>(test::fullCylinderWall({1600, 1200}, {0.9, 0.3, 1.2}))};
    for (int i = 0; i < 100; ++i) {
        RenderRequest request;
        request.wall = walls[i % 2];
        request.scene = room;
        request.output = OutputKind::coverage;
        // The eye stays half a metre from the room's walls; it is up to 1.6 m from the camera's position.
        request.camera = {
            {random.uniform(-1.9, 1.9), random.uniform(-0.4, 0.4), random.uniform(-1.9, 1.9)},
            {random.uniform(-kPi, kPi), random.uniform(-kPi / 2, kPi / 2), random.uniform(-kPi, kPi)}};
        if (i < 50) request.camera.orientation.pitchRad = request.camera.orientation.rollRad = 0;
        const Frame coverage = renderer_.render(request).frame;
        const auto wrong = std::ranges::count_if(coverage.texels, [](float count) { return count != 1; });
        ASSERT_EQ(wrong, 0) << "eye and orientation " << i;
    }
}

TEST_F(Piecewise, PolygonsOfUpToSixEdgesCoverEveryPixelOfAClosedRoomOnce) {
    test::Random random(2);
    const glm::ivec2 sizePx(400, 300);
    const Wall wall = test::planarWall(sizePx, 100);
    const auto requestWith = [&](std::shared_ptr<const FittedPieces> pieces) {
        RenderRequest request = test::requestFor(wall, loadScene("room"), {{0.3, 0.2, -0.7}, {1, 0.3, 0.2}});
        request.pieces = std::move(pieces);
        return request;
    };
    const Frame expected = renderer_.render(requestWith(nullptr)).frame;  // one piece serves a flat display
    for (const test::Honeycomb& honeycomb : {test::Honeycomb{4, 3, 1, 0}, {60, 45, 1, 0}}) {
        auto pieces = std::make_shared<FittedPieces>();
        pieces->mesh = test::honeycombOn(*wall.displays[0].projection, sizePx, honeycomb, random);
        pieces->owners = std::make_shared<const std::vector<int32_t>>(ownerImage(pieces->mesh));
        RenderRequest request = requestWith(pieces);
        EXPECT_LT(compareColor(renderer_.render(request).frame, expected).shareOff, 1e-4);
        request.output = OutputKind::coverage;
        const RenderResult result = renderer_.render(request);
        EXPECT_EQ(static_cast<size_t>(result.stats.pieces), pieces->mesh.pieces.size());
        EXPECT_EQ(std::ranges::count_if(result.frame.texels, [](float count) { return count != 1; }), 0);
    }
}

// A walk over all of them goes round more often than llvmpipe lets the loops of a shader.
TEST_F(Piecewise, AWallThatManyPiecesShowIsWholeWhateverLooksThemUp) {
    constexpr glm::ivec2 kCells(300, 200);
    RenderRequest request = test::requestFor(test::planarWall({600, 400}, 90), loadScene("room"));
    const Display& display = request.wall->displays[0];
    PieceGrid grid{display.sizePx, kCells.x, kCells.y, {}};
    for (int y = 0; y <= kCells.y; ++y)
        for (int x = 0; x <= kCells.x; ++x) {
            const glm::dvec2 px(2 * x, 2 * y);
            grid.vertices.push_back({*display.projection->unproject(px), px});
        }
    auto pieces = std::make_shared<FittedPieces>();
    pieces->mesh = meshFromGrid(grid, true);
    pieces->owners =
        std::make_shared<const std::vector<int32_t>>(certifyPieces(*display.projection, pieces->mesh).owners);
    request.pieces = pieces;
    request.output = OutputKind::coverage;
    for (const Engine engine : {Engine::compute, Engine::geometry}) {
        request.engine = engine;
        const Frame coverage = renderer_.render(request).frame;
        EXPECT_EQ(std::ranges::count(coverage.texels, 1.0f), 600 * 400) << static_cast<int>(engine);
    }
}

TEST_F(Piecewise, AClosedRoomShowsNoBackgroundInColour) {
    test::Random random(2);
    RenderRequest request = test::requestFor(test::fullCylinderWall({1600, 1200}), loadScene("room"));
    const_cast<Wall&>(*request.wall).background = {1, 0, 1};
    request.style = Style::unlit;
    request.linearOutput = true;
    for (int i = 0; i < 20; ++i) {
        request.camera = {random.inBox(2),
                          {random.uniform(-kPi, kPi), random.uniform(-1, 1), random.uniform(-kPi, kPi)}};
        const Frame frame = renderer_.render(request).frame;
        for (size_t t = 0; t < frame.texels.size(); t += 3)
            ASSERT_FALSE(frame.texels[t] == 1 && frame.texels[t + 1] == 0 && frame.texels[t + 2] == 1);
    }
}

TEST_F(Piecewise, TheSameRequestGivesTheSameTexels) {
    const RenderRequest request =
        test::requestFor(test::fullCylinderWall(kSizePx), loadScene("city:5000"), cityCamera(77));
    const Frame first = renderer_.render(request).frame;
    EXPECT_EQ(first.texels, renderer_.render(request).frame.texels);
    EXPECT_EQ(first.texels, Renderer().render(request).frame.texels);
}

TEST_F(Piecewise, PairBuffersGrowUntilEveryPairHasRoom) {
    // Each triangle crosses every piece, many times more than the buffers are made for at first.
    Scene scene;
    for (int i = 0; i < 1000; ++i) {
        startMaterial(scene, plainMaterial(glm::vec3(i % 2, 0.2, 0.5)));
        const float y = -2 + 0.004f * static_cast<float>(i);
        for (int k = 0; k < 3; ++k) {
            const auto at = [&](int corner) {
                const double angle = 2 * kPi * corner / 3;
                return glm::vec3(3 * std::sin(angle), y, 3 * std::cos(angle));
            };
            addTriangle(scene, {at(k), at(k + 1), at(k) + glm::vec3(0, 0.002f, 0)});
        }
    }
    RenderRequest request = test::requestFor(test::fullCylinderWall({1600, 1200}), std::move(scene));
    request.style = Style::unlit;
    request.tolerancePx = 0.02;
    const RenderResult result = renderer_.render(request);
    EXPECT_GT(result.stats.pairs, 1u << 16);
    EXPECT_LT(compareColor(result.frame, test::referenceOf(request).frame).shareOff, 0.01);
}

TEST_F(Piecewise, OnePieceIsOnePlainDraw) {
    const RenderRequest request =
        test::requestFor(test::planarWall(kSizePx, 90), loadScene("city"), cityCamera());
    const RenderResult result = renderer_.render(request);
    EXPECT_EQ(result.stats.engine, "plain");
    EXPECT_EQ(result.stats.pieces, 1);
    // A quarter of the city lies ahead.
    EXPECT_LT(result.stats.pairs, result.stats.triangles / 2);
    EXPECT_LT(compareColor(result.frame, test::referenceOf(request).frame).shareOff, 0.002);
}

TEST_F(Piecewise, StatsOfTheFirstFrameDoNotDependOnTheOthers) {
    RenderRequest request =
        test::requestFor(test::fullCylinderWall({400, 300}), loadScene("city:5000"), cityCamera());
    const RenderResult one = renderer_.render(request);
    request.frames = 3;
    const RenderResult three = renderer_.render(request);
    EXPECT_EQ(one.stats.pairs, three.stats.pairs);
    EXPECT_EQ(one.frame.texels, three.frame.texels);
    EXPECT_GT(one.stats.replicationRatio(), 0.5);
    EXPECT_LE(three.stats.frameMsMin, three.stats.frameMsMedian);
    EXPECT_LE(three.stats.frameMsMedian, three.stats.frameMsMax);
}

TEST_F(Piecewise, MoreSamplesComeNearerToTheConvergedPicture) {
    RenderRequest request =
        test::requestFor(test::fullCylinderWall({400, 300}), loadScene("city:5000"), cityCamera(20));
    request.samples = 256;
    const Frame truth = test::referenceOf(request).frame;
    // Four are the hardware's, 64 are more than any driver has.
    double nearer = 0;
    for (int samples : {1, 4, 64}) {
        request.samples = samples;
        const double psnrDb = compareColor(renderer_.render(request).frame, truth).psnrDb;
        EXPECT_GT(psnrDb, nearer + 2) << samples << " samples";
        nearer = psnrDb;
    }
}

TEST_F(Piecewise, EverySampleOfAClosedRoomIsCovered) {
    RenderRequest request = test::requestFor(test::fullCylinderWall({400, 300}), loadScene("room"));
    Wall pinkOutside = *request.wall;
    pinkOutside.background = {100, 0, 100};
    request.wall = std::make_shared<const Wall>(pinkOutside);
    request.linearOutput = true;
    for (int samples : {4, 16, 65}) {
        request.samples = samples;
        const Frame frame = renderer_.render(request).frame;
        EXPECT_LT(*std::ranges::max_element(frame.texels), 1.5f) << samples << " samples";
    }
}

// Single-sided triangles: seen from the front, or not at all, on flat and on curved displays.
TEST_F(Piecewise, TrianglesSeenFromBehindAreDrawnOnlyWhenTheirMaterialIsDoubleSided) {
    for (const bool doubleSided : {true, false}) {
        Scene scene;
        Material material = plainMaterial({0.9, 0.5, 0.1});
        material.doubleSided = doubleSided;
        startMaterial(scene, material);
        addFrontalSquare(scene, {0, 0, -3}, 3);  // its front faces the eye
        addQuad(scene, {glm::vec3(2, -1, -1), glm::vec3(2, -1, 1), glm::vec3(2, 1, 1), glm::vec3(2, 1, -1)});
        addQuad(scene,
                {glm::vec3(-2, -1, -1), glm::vec3(-2, -1, 1), glm::vec3(-2, 1, 1), glm::vec3(-2, 1, -1)});
        for (const Wall& wall : {test::fullCylinderWall({400, 300}), test::planarWall({400, 300}, 140)}) {
            const RenderRequest request = test::requestFor(wall, scene);
            EXPECT_LT(test::differenceFromReference(request).shareOff, 0.004) << wall.name << doubleSided;
        }
    }
}

TEST_F(Piecewise, AlphaMasksLetTheBackgroundThrough) {
    const RenderRequest request = test::requestFor(test::fullCylinderWall({400, 300}), maskedSquare());
    EXPECT_LT(test::differenceFromReference(request).shareOff, 0.002);
    const Frame frame = Renderer().render(request).frame;
    EXPECT_EQ(*frame.at(225, 150), 0);  // the transparent half
}

}  // namespace
}  // namespace curvewall
