// Maps and displays that measurements, programs and typing errors leave behind: drawn rightly or refused.
// Most take a tenth of a second, noise about one.

#include "calibration/errors.h"
#include "calibration/pieces/piece_fit.h"
#include "renderer/scene/load_scene.h"
#include "tests/hard_cases/wall_files.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/random_numbers.h"
#include "tests/support/rendering.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvewall {
namespace {

using nlohmann::json;
using test::mapOf;
constexpr glm::ivec2 kSizePx(160, 120);
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

glm::dvec3 onBarrel(glm::dvec2 at) {
    const double angle = 2.2 * (at.x - 0.5), h = 1 - 2 * at.y, radius = 3 - 0.3 * h * h;
    return {radius * std::sin(angle), 1.2 * h, -radius * std::cos(angle)};
}

class BrokenMaps : public test::GlTest {
protected:
    Wall camera(const NumberMap& map, const std::string& direction,
                const std::string& alignment = "corners") {
        folder_.write("offsets.pfm", test::pfmBytes(map));
        return test::readWallOf(folder_, test::cameraTexture("offsets.pfm", direction, alignment), kSizePx);
    }
    Wall surface(const NumberMap& map, glm::dvec3 eyeM = {}, const std::string& alignment = "corners") {
        folder_.write("points.pfm", test::pfmBytes(map));
        return test::readWallOf(folder_, test::surfaceMap("points.pfm", alignment), kSizePx, eyeM);
    }

    // Certified at every pixel, covered once where there is a ray, and the picture is the reference's but for
    // `shareOff` of its pixels. Facets that are seen nearly edge-on lose single pixels to single precision:
    // `mostUncovered` of them.
    void expectDrawn(const Wall& wall, double shareOff, int mostUncovered = 0) {
        const Display& display = wall.displays.front();
        for (const double tolerancePx : {1.0, 0.25}) {
            const Certificate certificate =
                fitPieces(*display.projection, display.sizePx, tolerancePx).certificate;
            EXPECT_LE(certificate.maxPx, tolerancePx);
            EXPECT_EQ(certificate.uncoveredPixels, 0);
        }
        RenderRequest request = test::requestFor(wall, room_, {{0.4, 0.2, -0.3}, {0.3, 0.1, 0.2}});
        EXPECT_LE(test::differenceFromReference(request).shareOff, shareOff);
        request.output = OutputKind::coverage;
        const Frame coverage = Renderer().render(request).frame;
        int wrong = 0;
        for (int y = 0; y < display.sizePx.y; ++y)
            for (int x = 0; x < display.sizePx.x; ++x)
                wrong +=
                    *coverage.at(x, y) != (display.projection->unproject({x + 0.5, y + 0.5}) ? 1.0f : 0.0f);
        EXPECT_LE(wrong, mostUncovered);
    }

    Frame pictureOf(const Wall& wall) {
        return Renderer().render(test::requestFor(wall, room_, {{0.4, 0.2, -0.3}, {}})).frame;
    }

    test::TemporaryFolder folder_;
    Scene room_ = loadScene("room");
};

TEST_F(BrokenMaps, FoldsInCameraTextures) {
    const auto folded = [](glm::dvec2 at) {
        return glm::dvec3(30 * std::sin(7.85 * at.x) + 4 * at.y, 6 * std::sin(3 * at.x), 0);
    };
    for (const char* direction : {"forward", "inverse"})
        expectDrawn(camera(mapOf({33, 25}, true, folded), direction), 0.01, 2);
}

TEST_F(BrokenMaps, ATurnAndAHalfShowsBothCopies) {
    const glm::ivec2 size(300, 100);
    const json cylinder = {{"type", "cylinder"}, {"radius", 2}, {"arc_deg", 540}, {"height", 3}};
    const json panorama = {
        {"type", "equirectangular"}, {"horizontal_fov_deg", 540}, {"vertical_fov_deg", 120}};
    for (const json& projection : {cylinder, panorama}) {
        const Wall wall = test::readWallOf(folder_, projection, size);
        expectDrawn(wall, 0.01);
        const Frame picture = pictureOf(wall);
        Frame left = picture, right = picture;
        for (Frame* half : {&left, &right}) half->sizePx.x = 100;
        left.texels.clear();
        right.texels.clear();
        for (int y = 0; y < size.y; ++y) {
            left.texels.insert(left.texels.end(), picture.at(0, y), picture.at(100, y));
            right.texels.insert(right.texels.end(), picture.at(200, y), picture.at(200, y) + 300);
        }
        EXPECT_LT(compareColor(left, right).shareOff, 0.01);
    }
}

TEST_F(BrokenMaps, IslandsOfNumbers) {
    const auto sparse = [](const test::NumbersAt& numbers) {
        return [random = std::make_shared<test::Random>(1), numbers](glm::dvec2 at) {
            return random->uniform(0, 1) < 0.2 ? glm::dvec3(kNan) : numbers(at);
        };
    };
    const auto bent = [](glm::dvec2 at) { return glm::dvec3(8 * at.x * at.y, 5 * std::sin(4 * at.x), 0); };
    for (const char* direction : {"forward", "inverse"})
        expectDrawn(camera(mapOf({33, 25}, true, sparse(bent)), direction), 0.01);
    expectDrawn(surface(mapOf({33, 25}, true, sparse(onBarrel)), {0.5, 0, 0.3}), 0.01);
}

TEST_F(BrokenMaps, AMapAsFineAsTheDisplayWithARandomFifthOfItMissing) {
    test::Random random(2);
    expectDrawn(surface(mapOf(kSizePx, false,
                              [&](glm::dvec2 at) {
                                  return random.uniform(0, 1) < 0.2 ? glm::dvec3(kNan) : onBarrel(at);
                              }),
                        {}, "centers"),
                0.01);
}

TEST_F(BrokenMaps, GridsOfOneCell) {
    const auto tilted = [](glm::dvec2 at) { return glm::dvec3(9 * at.x - 4 * at.y, 6 * at.y * at.x, 0); };
    for (const char* direction : {"forward", "inverse"})
        expectDrawn(camera(mapOf({2, 2}, true, tilted), direction), 0.01);
    const auto twisted = [](glm::dvec2 at) {
        return glm::dvec3(2 * at.x - 1, 1 - 2 * at.y, -1 - 0.5 * at.x * at.y);
    };
    expectDrawn(surface(mapOf({2, 2}, true, twisted)), 0.01);
}

TEST_F(BrokenMaps, ConstantOffsetsAreAPlanarPictureMovedAside) {
    const auto constant = [](glm::dvec2) { return glm::dvec3(10, -6, 0); };
    // Inverse: each pixel shows what the base has 10 px to the right and 6 px further up.
    const double right = 1, up = std::tan(36.87 * M_PI / 180);
    const double x0 = -right + 2 * right * 10 / kSizePx.x, x1 = right + 2 * right * 10 / kSizePx.x;
    const double y0 = -up + 2 * up * 6 / kSizePx.y, y1 = up + 2 * up * 6 / kSizePx.y;
    const Wall planar = test::readWallOf(folder_,
                                         {{"type", "planar"},
                                          {"lower_left", {x0, y0, -1}},
                                          {"lower_right", {x1, y0, -1}},
                                          {"upper_left", {x0, y1, -1}}},
                                         kSizePx);
    for (const auto& [nodes, alignment] : {std::pair{glm::ivec2(1, 1), "centers"}, {{2, 2}, "corners"}}) {
        const NumberMap map = mapOf(nodes, std::string(alignment) == "corners", constant);
        const Wall inverse = camera(map, "inverse", alignment);
        EXPECT_LT(compareColor(pictureOf(inverse), pictureOf(planar)).shareOff, 1e-3);
        expectDrawn(inverse, 0.001);
        expectDrawn(camera(map, "forward", alignment), 0.001);
    }
}

TEST_F(BrokenMaps, CellsThatCollapse) {
    // Nodes 3 and 4 of each row fall together.
    const auto pinched = [](glm::dvec2 at) {
        const double column = std::round(8 * at.x);
        return glm::dvec3(column == 4 ? -kSizePx.x / 8.0 : 0.0, 3 * at.y * at.y, 0);
    };
    for (const char* direction : {"forward", "inverse"})
        expectDrawn(camera(mapOf({9, 7}, true, pinched), direction), 0.01);
}

TEST_F(BrokenMaps, MapsThatCollapseEverywhereAreRefused) {
    const auto toOnePoint = [](glm::dvec2 at) {
        return glm::dvec3(glm::dvec2(80, 60) - at * glm::dvec2(kSizePx), 0);
    };
    for (const char* direction : {"forward", "inverse"})
        EXPECT_THROW(camera(mapOf({5, 5}, true, toOnePoint), direction), InputError);
    EXPECT_THROW(surface(mapOf({5, 5}, true, [](glm::dvec2) { return glm::dvec3(1, 2, -3); })), InputError);
}

TEST_F(BrokenMaps, MapsWithoutANumberAreRefused) {
    for (const double none : {kNan, kInfinity, -kInfinity, 1e30, -1e30}) {
        const auto nothing = [none](glm::dvec2) { return glm::dvec3(none); };
        for (const char* direction : {"forward", "inverse"})
            EXPECT_THROW(camera(mapOf({5, 5}, true, nothing), direction), InputError) << none;
        EXPECT_THROW(surface(mapOf({5, 5}, true, nothing)), InputError) << none;
    }
}

TEST_F(BrokenMaps, InfiniteAndHugeNumbersAmongOthersAreHoles) {
    int node = 0;
    const auto some = [&node](const test::NumbersAt& numbers) {
        return [&node, numbers](glm::dvec2 at) {
            constexpr std::array<double, 4> kBad{kInfinity, -kInfinity, 1e30, -1e30};
            const int n = node++;
            return n % 11 == 5 ? glm::dvec3(kBad[static_cast<size_t>(n / 11) % 4]) : numbers(at);
        };
    };
    const auto none = [](glm::dvec2) { return glm::dvec3(0); };
    for (const char* direction : {"forward", "inverse"})
        expectDrawn(camera(mapOf({17, 13}, true, some(none)), direction), 0.01);
    expectDrawn(surface(mapOf({17, 13}, true, some(onBarrel))), 0.01);
}

TEST_F(BrokenMaps, NoiseIsDrawnPixelByPixel) {
    test::Random random(3);
    const auto noise = [&](glm::dvec2) { return random.inBox(60); };
    expectDrawn(camera(mapOf(kSizePx, false, noise), "inverse", "centers"), 0.05, 16);
    const auto points = [&](glm::dvec2) { return 3.0 * random.direction(); };
    expectDrawn(surface(mapOf(kSizePx, false, points), {}, "centers"), 0.05, 16);
}

TEST_F(BrokenMaps, TheEyeOnAPointOfTheSurface) {
    // The point of the pixel's centre, of a node, and of a place between.
    const NumberMap map = mapOf({17, 13}, true, onBarrel);
    const Wall wall = surface(map, {0, 0, 1});
    for (const glm::dvec2 px : {glm::dvec2(80.5, 60.5), {80, 60}, {33.3, 21.7}}) {
        const glm::dvec3 eye = glm::dvec3(0, 0, 1) + *wall.displays[0].projection->unproject(px);
        expectDrawn(surface(map, eye), 0.04, 128);
    }
}

TEST_F(BrokenMaps, TheEyeInThePlaneOfAFlatSurfaceIsRefusedOrDrawn) {
    const auto flat = [](glm::dvec2 at) { return glm::dvec3(2 * at.x - 1, 1 - 2 * at.y, -1); };
    const Wall wall = surface(mapOf({5, 5}, true, flat), {0.1, 0.2, -1});
    try {
        expectDrawn(wall, 1);
    } catch (const UsageError&) {
    }
}

struct Small {
    std::string name;
    json projection;
};
void PrintTo(const Small& small, std::ostream* out) { *out << small.name; }

class SmallDisplays : public BrokenMaps, public ::testing::WithParamInterface<Small> {};

TEST_P(SmallDisplays, AreDrawn) {
    folder_.write("offsets.pfm",
                  test::pfmBytes(mapOf({3, 3}, true, [](glm::dvec2 at) { return glm::dvec3(0.3 * at.y); })));
    folder_.write("points.pfm", test::pfmBytes(mapOf({9, 9}, true, onBarrel)));
    folder_.write("mesh.json", R"({"grid": [2, 2], "vertices": [[0, 0, 0.2, 0.1], [1, 0, 0.9, 0.2],
                                                                [0, 1, 0.2, 0.8], [1, 1, 0.8, 0.9]]})");
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {1, 2000}, {3, 3}, {2000, 1}})
        // A quarter of a pixel is a large part of what such a display shows; the certificate and the cover
        // count.
        expectDrawn(test::readWallOf(folder_, GetParam().projection, size), 0.75);
}

std::vector<Small> smallKinds() {
    const json source = {
        {"size", {100, 100}},
        {"projection", {{"type", "equirectangular"}, {"horizontal_fov_deg", 90}, {"vertical_fov_deg", 90}}}};
    return {
        {"Planar",
         {{"type", "planar"},
          {"lower_left", {-1, -1, -1}},
          {"lower_right", {1, -1, -1}},
          {"upper_left", {-1, 1, -1}}}},
        {"Cylinder", {{"type", "cylinder"}, {"radius", 2}, {"arc_deg", 200}, {"height", 3}}},
        {"Radial", {{"type", "radial"}, {"model", "equidistant"}, {"fov_deg", 180}}},
        {"Equirectangular",
         {{"type", "equirectangular"}, {"horizontal_fov_deg", 360}, {"vertical_fov_deg", 180}}},
        {"SphereSlices", {{"type", "sphere_slices"}, {"horizontal_fov_deg", 180}, {"vertical_fov_deg", 180}}},
        {"Curvilinear", {{"type", "curvilinear"}, {"fov_deg", 130}}},
        {"Camera",
         {{"type", "camera"},
          {"model", "pinhole"},
          {"focal_px", {900, 900}},
          {"principal_px", {0, 0}},
          {"distortion", {-0.1, 0.02, 0, 0}}}},
        {"CameraTextureForward", test::cameraTexture("offsets.pfm", "forward")},
        {"CameraTextureInverse", test::cameraTexture("offsets.pfm", "inverse")},
        {"SurfaceMap", test::surfaceMap("points.pfm")},
        {"WarpMesh",
         {{"type", "warp_mesh"},
          {"mesh", "mesh.json"},
          {"screen_units", "normalized"},
          {"source_origin", "top_left"},
          {"source", source}}}};
}

INSTANTIATE_TEST_SUITE_P(Kinds, SmallDisplays, ::testing::ValuesIn(smallKinds()),
                         [](const auto& kind) { return kind.param.name; });

}  // namespace
}  // namespace curvewall
