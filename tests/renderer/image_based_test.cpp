#include "calibration/errors.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"
#include "calibration/projections/sphere_slices_lens.h"
#include "renderer/prepared_images.h"
#include "renderer/scene/load_scene.h"
#include "tests/hard_cases/wall_files.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/rendering.h"
#include "tests/support/test_projections.h"
#include "tests/support/test_scenes.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

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
    // What a coarse mesh interpolates is part of it.
    room.lookup = SourceLookup::mesh;
    room.meshStepPx = 64;
    const RenderResult coarse = Renderer().render(room);
    EXPECT_GT(coarse.stats.geometricError.maxPx, planar.stats.geometricError.maxPx + 1);
    EXPECT_GT(coarse.stats.lookupError.maxPx, 1);
    EXPECT_NEAR(largestOffsetPx(coarse.frame, part), coarse.stats.geometricError.maxPx, 0.05);
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
    room.filter = SourceFilter::mipmap;
    room.facePass = FacePass::layered;
    room.lookup = SourceLookup::mesh;
    room.meshStepPx = 8;
    const RenderStats stats = Renderer().render(room).stats;
    EXPECT_EQ(stats.filter, "mipmap");
    EXPECT_EQ(stats.facePass, "layered");
    EXPECT_EQ(stats.lookup, "mesh");
    EXPECT_EQ(stats.meshStepPx, 8);
    EXPECT_GT(stats.levels, 0);
    // 64 texels across the whole width, and the aprons that the levels need.
    EXPECT_GT(stats.sourceTexels, 64u * 40);
    EXPECT_LT(stats.sourceTexels, 100u * 90);
    room.output = OutputKind::depth;
    EXPECT_EQ(Renderer().render(room).stats.filter, "nearest");
    EXPECT_EQ(Renderer().render(room).stats.levels, 0);
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
    const auto source = images.source(wall, display, {.faceSizePx = 64});
    EXPECT_EQ(images.source(wall, display, {.faceSizePx = 64}), source);
    for (const SourceSettings& other : {SourceSettings{.faceSizePx = 128},
                                        {.faceSizePx = 64, .hasLevels = true},
                                        {.faceSizePx = 64, .pass = FacePass::layered},
                                        {.faceSizePx = 64, .lookup = SourceLookup::mesh, .meshStepPx = 16}})
        EXPECT_NE(images.source(wall, display, other), source);
    const auto pictures = images.pictures(source->gpu, {}, 4);
    EXPECT_EQ(images.pictures(source->gpu, {}, 4), pictures);
    EXPECT_NE(images.pictures(source->gpu, {}, 1), pictures);
    // One large set at a time.
    const auto many = images.source(wall, display, {.faceSizePx = 2048});
    const std::weak_ptr large = images.pictures(many->gpu, {}, 1);
    EXPECT_FALSE(large.expired());
    images.pictures(images.source(wall, display, {.faceSizePx = 2000})->gpu, {}, 1);
    EXPECT_TRUE(large.expired());
    EXPECT_EQ(images.pictures(source->gpu, {}, 4), pictures);
    const auto resampler = images.resampler(SourceFilter::linear, SourceLookup::pixel);
    EXPECT_EQ(images.resampler(SourceFilter::linear, SourceLookup::pixel), resampler);
    EXPECT_NE(images.resampler(SourceFilter::linear, SourceLookup::mesh), resampler);
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

Wall lensWall(LensPtr lens, glm::ivec2 sizePx) {
    const Orientation orientation{0.4, 0.6, 0.1};
    return {"lens",
            {},
            {},
            {{"front", sizePx, "lens", std::make_shared<LensProjection>(std::move(lens), orientation)}}};
}

Wall domeWall(glm::ivec2 sizePx, double fovRad = test::kPi) {
    return lensWall(circularLens({}, fovRad, sizePx), sizePx);
}

Wall slicesWall(glm::ivec2 sizePx) {
    // To 170 degrees: at the ends of whole half turns, all rows see the same.
    constexpr double kFovRad = 2.97;
    return lensWall(std::make_shared<SphereSlicesLens>(kFovRad, kFovRad, sizePx), sizePx);
}

Wall cameraTextureWall(glm::ivec2 sizePx) {
    const test::TemporaryFolder folder;
    const auto bent = [&](glm::dvec2 at) {
        const glm::dvec2 c = at - 0.5;
        return glm::dvec3(sizePx.x * -0.1 * c.x * (4 * c.x * c.x - 1),
                          sizePx.y * 0.14 * c.y * (1 - 4 * c.x * c.x), 0);
    };
    folder.write("offsets.pfm", test::pfmBytes(test::mapOf({33, 33}, true, bent)));
    return test::readWallOf(folder, test::cameraTexture("offsets.pfm", "inverse"), sizePx);
}

struct DisplayCase {
    std::string name;
    std::function<Wall()> wall;
    std::vector<SourceKind> sources;
};

void PrintTo(const DisplayCase& display, std::ostream* out) { *out << display.name; }

std::vector<DisplayCase> displayCases() {
    using enum SourceKind;
    return {{"Planar",
             [] {
                 return test::planarWall({200, 150}, 80);
             },
             {cube, hemicube, planar}},
            {"Cylinder",
             [] {
                 return test::cylinderWall({2, 2.5, 2, {}, {}}, {0.4, 0.1, 0.3}, {240, 120});
             },
             {cube, hemicube, planar}},
            {"FullCylinder",
             [] {
                 return test::fullCylinderWall({240, 180});
             },
             {cube}},
            {"Dome",
             [] {
                 return domeWall({200, 200});
             },
             {cube, hemicube}},
            {"CameraTexture",
             [] {
                 return cameraTextureWall({200, 150});
             },
             {cube, hemicube, planar}},
            {"SphereSlices",
             [] {
                 return slicesWall({200, 200});
             },
             {cube, hemicube}}};
}

class ImageBasedOn : public ImageBased, public ::testing::WithParamInterface<DisplayCase> {};

// Flat colours: what is off lies along edges, which the texels blur. At one texel a pixel a linear filter
// spreads an edge over two pixels; in a closed room some pixels in a hundred are that near to one.
TEST_P(ImageBasedOn, EverySourceFilterLookupAndPassAgreesWithTheReference) {
    RenderRequest room = request(GetParam().wall(), boxRoom({8, 5, 8}), 0);
    room.camera = {{0.5, 0.3, 1}, {0.7, 0.2, 0.1}};
    room.style = Style::unlit;
    room.meshStepPx = 8;
    const Frame truth = test::referenceOf(room).frame;
    Renderer renderer;
    for (const SourceKind source : GetParam().sources) {
        for (const SourceFilter filter : {SourceFilter::nearest, SourceFilter::linear, SourceFilter::bicubic,
                                          SourceFilter::mipmap, SourceFilter::anisotropic}) {
            for (const SourceLookup lookup : {SourceLookup::pixel, SourceLookup::mesh}) {
                Frame separate;
                for (const FacePass pass : {FacePass::separate, FacePass::layered}) {
                    room.source = source, room.filter = filter, room.lookup = lookup, room.facePass = pass;
                    const Frame frame = renderer.render(room).frame;
                    const ImageDifference off = compareColor(frame, truth);
                    const std::string which = std::to_string(int(source)) + " " +
                                              std::to_string(int(filter)) + " " + std::to_string(int(lookup));
                    EXPECT_LT(off.shareOff, filter == SourceFilter::nearest ? 0.01 : 0.045) << which;
                    EXPECT_GT(off.psnrDb, 27) << which;
                    if (pass == FacePass::separate)
                        separate = frame;
                    else
                        EXPECT_LE(compareColor(frame, separate).maxDifference, 1) << which;
                }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Displays, ImageBasedOn, ::testing::ValuesIn(displayCases()),
                         [](const auto& test) { return test.param.name; });

TEST_F(ImageBased, LayeredFacesShowWhatSeparateOnesDo) {
    // Two-sided and one-sided, textured, masked and lit.
    RenderRequest city = request(domeWall({200, 200}, 5), loadScene("city:5000"), 150);
    Renderer renderer;
    const auto bothOf = [&](const RenderRequest& asked) {
        RenderRequest layered = asked;
        layered.facePass = FacePass::layered;
        return std::pair{renderer.render(asked), renderer.render(layered)};
    };
    for (const Style style : {Style::textured, Style::unlit, Style::wireframe, Style::penAndInk}) {
        city.style = style;
        const auto [separate, layered] = bothOf(city);
        EXPECT_LE(compareColor(layered.frame, separate.frame).maxDifference, 1) << int(style);
        EXPECT_EQ(layered.stats.attributes, separate.stats.attributes);
        // Those beside a face are left out triangle by triangle, and not by their meshlet.
        EXPECT_LT(layered.stats.pairs, separate.stats.pairs);
        EXPECT_GT(layered.stats.pairs, 100u);
    }
    city.style = Style::textured;
    city.samples = 4;
    const auto [separate, layered] = bothOf(city);
    EXPECT_LE(compareColor(layered.frame, separate.frame).maxDifference, 1);
    city.samples = 1;
    for (const OutputKind output : {OutputKind::depth, OutputKind::coverage, OutputKind::position}) {
        city.output = output;
        const auto [one, all] = bothOf(city);
        size_t off = 0;
        for (size_t i = 0; i < one.frame.texels.size(); ++i) {
            const float a = one.frame.texels[i], b = all.frame.texels[i];
            off += std::isfinite(a) != std::isfinite(b) || std::abs(a - b) > 1e-4f * std::abs(a);
        }
        EXPECT_EQ(off, 0u) << int(output);
    }
}

TEST_F(ImageBased, LayeredFacesBlendAndCullLikeSeparateOnes) {
    Scene scene = boxRoom({8, 5, 8});
    Material glass = plainMaterial({0.2, 0.9, 0.4});
    glass.baseColor.a = 0.4f;
    glass.blending = Blending::alpha;
    glass.doubleSided = true;
    startMaterial(scene, glass);
    addFrontalSquare(scene, {0.5, 0, -1.5}, 3);
    addFrontalSquare(scene, {-1.5, 0, -2.5}, 3);
    Material oneSided = plainMaterial({0.9, 0.9, 0.9});
    oneSided.doubleSided = false;
    startMaterial(scene, oneSided);
    addFrontalSquare(scene, {0.8, 0.4, -2}, 1);
    addFrontalSquare(scene, {0.8, 0.4, 2}, 1);  // seen from behind
    for (const double originM : {0.0, 1e6}) {
        Scene far = scene;
        far.originM = glm::dvec3(originM, 0, -originM);
        RenderRequest room = request(test::fullCylinderWall({240, 180}), far, 128);
        room.camera = {far.originM + glm::dvec3(0.1, 0.2, 0), {0.4, 0, 0}};
        const Frame truth = test::referenceOf(room).frame;
        const Frame separate = Renderer().render(room).frame;
        room.facePass = FacePass::layered;
        const Frame layered = Renderer().render(room).frame;
        EXPECT_LE(compareColor(layered, separate).maxDifference, 1);
        EXPECT_LT(compareColor(layered, truth).shareOff, 0.04);
    }
}

TEST_F(ImageBased, RefusesWhatLayeredFacesCannotHold) {
    Scene scene = boxRoom({8, 5, 8});
    RenderRequest room = request(test::planarWall({40, 30}, 80), scene, 64);
    room.facePass = FacePass::layered;
    room.samples = 65;
    EXPECT_THROW(Renderer().render(room), UsageError);
    room.samples = 1;
    EXPECT_NO_THROW(Renderer().render(room));
    scene.points = {0};
    scene.pointRanges = {{0, 0, 1}};
    room.scene = std::make_shared<const Scene>(scene);
    EXPECT_THROW(Renderer().render(room), UsageError);
    room.facePass = FacePass::separate;
    EXPECT_NO_THROW(Renderer().render(room));
}

TEST_F(ImageBased, ADisplayThatShowsNothingIsBackgroundHoweverItIsDrawn) {
    const auto nothing = std::make_shared<RayFunctionProjection>([](glm::dvec2) { return std::nullopt; });
    RenderRequest room = request(wallOf(nothing, {8, 8}), boxRoom({8, 5, 8}), 0);
    for (const FacePass pass : {FacePass::separate, FacePass::layered})
        for (const SourceLookup lookup : {SourceLookup::pixel, SourceLookup::mesh})
            for (const SourceKind source : {SourceKind::cube, SourceKind::hemicube, SourceKind::planar}) {
                room.facePass = pass, room.lookup = lookup, room.source = source;
                const RenderResult result = Renderer().render(room);
                EXPECT_EQ(result.stats.faces, 0);
                for (const float value : result.frame.texels) ASSERT_EQ(value, 0);
            }
}

TEST_F(ImageBased, LevelsTakeTheAliasesOutOfASourceThatIsFinerThanItsDisplay) {
    // Against the average over each pixel. A linear filter of a source with k texels a pixel looks at four of
    // them; levels look at all.
    RenderRequest city = request(test::fullCylinderWall({200, 150}), loadScene("city"), 1024);
    city.samples = 64;
    const Frame truth = test::referenceOf(city).frame;
    city.samples = 1;
    Renderer renderer;
    const auto psnrDb = [&](SourceFilter filter, int faceSizePx) {
        city.filter = filter;
        city.faceSizePx = faceSizePx;
        return compareColor(renderer.render(city).frame, truth).psnrDb;
    };
    const double linear = psnrDb(SourceFilter::linear, 1024), mipmap = psnrDb(SourceFilter::mipmap, 1024);
    EXPECT_GT(mipmap, linear + 4);
    // What the pixel covers is not a square.
    EXPECT_GT(psnrDb(SourceFilter::anisotropic, 1024), mipmap + 1);
    // A finer source is a supersampled one only where all of its texels count.
    EXPECT_GT(mipmap, psnrDb(SourceFilter::mipmap, 64) + 2);
    EXPECT_LT(linear, psnrDb(SourceFilter::linear, 128) - 4);
}

}  // namespace
}  // namespace curvewall
