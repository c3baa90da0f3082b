#include "calibration/errors.h"
#include "renderer/prepared_images.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/rendering.h"
#include "tests/support/test_scenes.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace curvewall {
namespace {

class ImageBased : public test::GlTest {
protected:
    RenderRequest request(Wall wall, Scene scene, int faceSizePx) {
        RenderRequest made = test::requestFor(std::move(wall), std::move(scene), {{0, 8, 0}, {0.3, 0, 0}});
        made.method = Method::imageBased;
        made.faceSizePx = faceSizePx;
        return made;
    }
};

TEST_F(ImageBased, ComesNearerToTheReferenceWithLargerFaces) {
    // Flat colours, so that only the edges tell: their error is the blur of a texel.
    RenderRequest room = request(test::fullCylinderWall({400, 300}), boxRoom({8, 5, 8}), 0);
    room.camera = {{0.5, 0.3, 1}, {0.7, 0.2, 0.1}};
    room.style = Style::unlit;
    double worse = 1;
    for (int faceSizePx : {64, 256, 1024, 4096}) {
        room.faceSizePx = faceSizePx;
        const double shareOff = test::differenceFromReference(room).shareOff;
        EXPECT_LT(shareOff, worse);
        worse = shareOff;
    }
    EXPECT_LT(worse, 0.002);
}

TEST_F(ImageBased, CityAgreesWithTheReferenceAsFarAsResamplingGoes) {
    // Two texels a pixel. Every edge and every texel is filtered twice, which the piecewise picture is not.
    const RenderRequest city = request(test::fullCylinderWall({800, 600}), loadScene("city"), 1024);
    const ImageDifference difference = test::differenceFromReference(city);
    EXPECT_LT(difference.shareOff, 0.2);
    EXPECT_GT(difference.psnrDb, 24);
}

TEST_F(ImageBased, DrawsOnlyTheFacesThatTheDisplaySees) {
    Renderer renderer;
    EXPECT_EQ(renderer.render(request(test::planarWall({400, 300}, 80), loadScene("room"), 64)).stats.faces,
              1);
    EXPECT_EQ(renderer
                  .render(request(test::cylinderWall({2, test::kPi, 1, {}, {}}, {}, {400, 100}),
                                  loadScene("room"), 64))
                  .stats.faces,
              3);
    EXPECT_EQ(renderer.render(request(test::fullCylinderWall({400, 300}), loadScene("room"), 64)).stats.faces,
              6);
}

// For every pixel, the closed-form pixel of the position shown: the largest is what the stats say.
double largestOffsetPx(const Frame& positions, const CylinderWall& cylinder) {
    const glm::dvec2 size = positions.sizePx;
    double largest = 0;
    for (int y = 0; y < positions.sizePx.y; ++y) {
        for (int x = 0; x < positions.sizePx.x; ++x) {
            const float* p = positions.at(x, y);
            EXPECT_TRUE(std::isfinite(p[0]));
            const double px = size.x * (0.5 + std::atan2(p[0], -p[2]) / cylinder.arcRad);
            const double py =
                size.y * (0.5 - cylinder.radiusM * p[1] / std::hypot(p[0], p[2]) / cylinder.heightM);
            double dx = std::abs(px - x - 0.5);
            if (cylinder.arcRad == 2 * test::kPi) dx = std::min(dx, size.x - dx);
            largest = std::max(largest, std::hypot(dx, py - y - 0.5));
        }
    }
    return largest;
}

TEST_F(ImageBased, StatedErrorIsThatOfThePointsItShows) {
    const CylinderWall part{2, 1.7, 3, {}, {}};
    const glm::ivec2 sizePx(400, 300);
    RenderRequest room = request(test::fullCylinderWall(sizePx), loadScene("room"), 256);
    room.camera = {};
    room.output = OutputKind::position;
    const RenderResult cube = Renderer().render(room);
    EXPECT_NEAR(largestOffsetPx(cube.frame, test::fullCylinder(sizePx)), cube.stats.geometricError.maxPx,
                0.01);
    room.wall = std::make_shared<const Wall>(test::cylinderWall(part, {}, sizePx));
    room.source = SourceKind::planar;
    const RenderResult planar = Renderer().render(room);
    // Texels that reach beyond the display's edge are left out of the certificate.
    EXPECT_NEAR(largestOffsetPx(planar.frame, part), planar.stats.geometricError.maxPx, 0.05);
}

TEST_F(ImageBased, StatsTellTheSourceAndTheFilter) {
    RenderRequest room = request(test::planarWall({40, 30}, 80), loadScene("room"), 64);
    room.filter = SourceFilter::bicubic;
    for (const auto& [source, name] : {std::pair{SourceKind::cube, "cube"}, {SourceKind::planar, "planar"}}) {
        room.source = source;
        const RenderStats stats = Renderer().render(room).stats;
        EXPECT_EQ(stats.source, name);
        EXPECT_EQ(stats.filter, "bicubic");
        EXPECT_EQ(stats.faces, 1);
        EXPECT_EQ(stats.faceSizePx, 64);
    }
    room.output = OutputKind::depth;
    EXPECT_EQ(Renderer().render(room).stats.filter, "nearest");
}

double meanSquare(const Frame& a, const Frame& b) {
    double sum = 0;
    for (size_t i = 0; i < a.texels.size(); ++i) sum += std::pow(a.texels[i] - b.texels[i], 2);
    return sum / static_cast<double>(a.texels.size());
}

TEST_F(ImageBased, BicubicIsNearerToASmoothPictureThanLinear) {
    // One triangle whose normals turn: its light is smooth, and little of it is rounded.
    Scene scene;
    startMaterial(scene, plainMaterial({0.9, 0.6, 0.3}));
    addTriangle(scene, {glm::vec3(-20, -9, -2), glm::vec3(20, -9, -2), glm::vec3(0, 30, -2)});
    scene.normals = {glm::vec3(0, 0, 1), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)};  // exact in 10 bits
    RenderRequest smooth = request(test::cylinderWall({2, 1.8, 2, {}, {}}, {}, {400, 200}), scene, 64);
    smooth.camera = {};
    smooth.linearOutput = true;
    const Frame truth = test::referenceOf(smooth).frame;
    double worse = 1;
    for (const SourceFilter filter : {SourceFilter::nearest, SourceFilter::linear, SourceFilter::bicubic}) {
        smooth.filter = filter;
        const double error = meanSquare(Renderer().render(smooth).frame, truth);
        EXPECT_LT(error, worse / 100);
        worse = error;
    }
}

TEST_F(ImageBased, APlanarSourceIsNearTheReferenceWithFewTexels) {
    RenderRequest room =
        request(test::cylinderWall({2, 1.7, 3, {}, {}}, {}, {400, 300}), boxRoom({8, 5, 8}), 0);
    room.camera = {{0.5, 0.3, 1}, {0.7, 0.2, 0.1}};
    room.style = Style::unlit;
    room.source = SourceKind::planar;
    EXPECT_LT(test::differenceFromReference(room).shareOff, 0.02);
}

TEST_F(ImageBased, RefusesAPlanarSourceOfAFullTurn) {
    RenderRequest room = request(test::fullCylinderWall({400, 300}), loadScene("room"), 0);
    room.source = SourceKind::planar;
    EXPECT_THROW(Renderer().render(room), UsageError);
}

TEST_F(ImageBased, FaceSizeFollowsThePeakPixelDensity) {
    // A planar display of the width of one face: one texel for one pixel, to the next 16.
    RenderRequest planar = request(test::planarWall({400, 400}, 90), loadScene("room"), 0);
    EXPECT_EQ(Renderer().render(planar).stats.faceSizePx, 400);
}

TEST_F(ImageBased, SamplesComeNearerToTheConvergedPicture) {
    RenderRequest city = request(test::fullCylinderWall({400, 300}), loadScene("city:5000"), 256);
    city.samples = 256;
    const Frame truth = test::referenceOf(city).frame;
    Renderer renderer;
    const auto psnrDb = [&](int samples) {
        city.samples = samples;
        return compareColor(renderer.render(city).frame, truth).psnrDb;
    };
    // Four are the hardware's, 64 are more than any driver has. Beyond a few it is the filter that blurs.
    const double one = psnrDb(1);
    EXPECT_GT(psnrDb(4), one + 2);
    EXPECT_GT(psnrDb(64), one + 2);
}

TEST_F(ImageBased, OutputsThatHaveNoAverageTakeOneSample) {
    RenderRequest room = request(test::fullCylinderWall({40, 30}), loadScene("room"), 64);
    room.camera = {};
    room.output = OutputKind::position;
    const Frame one = Renderer().render(room).frame;
    room.samples = 4;
    EXPECT_EQ(Renderer().render(room).frame.texels, one.texels);
}

TEST_F(ImageBased, WhatIsPreparedIsKept) {
    const EglContext context;
    PreparedImages images;
    const auto wall = std::make_shared<const Wall>(test::fullCylinderWall({40, 30}));
    const Display& display = wall->displays[0];
    const auto source = images.source(wall, display, SourceKind::cube, 64);
    EXPECT_EQ(images.source(wall, display, SourceKind::cube, 64), source);
    EXPECT_NE(images.source(wall, display, SourceKind::cube, 128), source);
    const auto pictures = images.pictures(source->gpu, {}, 4);
    EXPECT_EQ(images.pictures(source->gpu, {}, 4), pictures);
    EXPECT_NE(images.pictures(source->gpu, {}, 1), pictures);
    // One large set at a time.
    const auto many = images.source(wall, display, SourceKind::cube, 2048);
    const std::weak_ptr large = images.pictures(many->gpu, {}, 1);
    EXPECT_FALSE(large.expired());
    images.pictures(images.source(wall, display, SourceKind::cube, 2000)->gpu, {}, 1);
    EXPECT_TRUE(large.expired());
    EXPECT_EQ(images.pictures(source->gpu, {}, 4), pictures);
    EXPECT_EQ(images.resampler(SourceFilter::linear), images.resampler(SourceFilter::linear));
}

TEST_F(ImageBased, TheSameRequestGivesTheSamePictureWhateverCameBetween) {
    Renderer renderer;
    RenderRequest room =
        request(test::cylinderWall({2, 1.7, 3, {}, {}}, {}, {80, 60}), loadScene("room"), 64);
    const Frame first = renderer.render(room).frame;
    RenderRequest other = room;
    for (const int samples : {1, 4, 65})
        for (const SourceKind source : {SourceKind::planar, SourceKind::cube})
            for (const SourceFilter filter : {SourceFilter::bicubic, SourceFilter::nearest}) {
                other.samples = samples, other.source = source, other.filter = filter;
                renderer.render(other);
            }
    EXPECT_EQ(renderer.render(room).frame.texels, first.texels);
}

}  // namespace
}  // namespace curvewall
