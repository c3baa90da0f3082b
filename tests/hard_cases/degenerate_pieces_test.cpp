// Projections at the end of what they can be: pieces meet the tolerance at every pixel, and say which pixels
// show nothing, or are refused with a reason.

#include "calibration/errors.h"
#include "renderer/scene/load_scene.h"
#include "tests/hard_cases/wall_files.h"
#include "tests/support/certificate_checks.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/rendering.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace curvewall {
namespace {

using nlohmann::json;
using test::mapOf;
constexpr double kPi = std::numbers::pi;

const json kFullCylinder{{"type", "cylinder"}, {"radius", 2.0}, {"arc_deg", 360}, {"height", 9.42477796}};
const json kFlatScreen{{"type", "planar"},
                       {"lower_left", {-1, -0.75, -1}},
                       {"lower_right", {1, -0.75, -1}},
                       {"upper_left", {-1, 0.75, -1}}};

json with(json projection, const json& changes) {
    projection.update(changes);
    return projection;
}

json fisheye(const std::string& model, double fovDeg) {
    return {{"type", "radial"}, {"model", model}, {"fov_deg", fovDeg}};
}

// An equidistant lens in a dome of 4 m.
json onDome(glm::dvec3 lensM, glm::dvec3 domeM = {}) {
    json projection = fisheye("equidistant", 180);
    projection["center"] = {lensM.x, lensM.y, lensM.z};
    projection["surface"] = {{"type", "sphere"}, {"center", {domeM.x, domeM.y, domeM.z}}, {"radius", 4.0}};
    return projection;
}

glm::dvec3 onBarrel(glm::dvec2 at) {
    const double angle = 2.2 * (at.x - 0.5), h = 1 - 2 * at.y, radius = 3 - 0.3 * h * h;
    return {radius * std::sin(angle), 1.2 * h, -radius * std::cos(angle)};
}
glm::dvec3 onFlatScreen(glm::dvec2 at) { return {2 * at.x - 1, 1 - 2 * at.y, -1}; }

// Across the middle of the display a step of one pixel along x is `scale` px: more than 0 is a map that
// nearly folds, less one that does.
test::NumbersAt foldingOffsets(glm::ivec2 sizePx, double scale) {
    return [swing = (1 - scale) * sizePx.x / (2 * kPi)](glm::dvec2 at) {
        return glm::dvec3(swing * std::sin(2 * kPi * at.x + at.y), 8 * std::sin(3 * at.y + at.x), 0);
    };
}

struct Fold {
    const char* name;
    double scale;
};
constexpr std::array<Fold, 5> kFolds{{{"NearFoldOfOneIn100", 0.01},
                                      {"NearFoldOfOneIn1000", 0.001},
                                      {"NearFoldOfOneIn100000", 1e-5},
                                      {"SlightFold", -0.01},
                                      {"Fold", -2}}};

struct Degenerate {
    std::string name;
    json projection;
    glm::ivec2 sizePx;
    glm::dvec3 eyeM{0};
};
void PrintTo(const Degenerate& degenerate, std::ostream* out) { *out << degenerate.name; }

class DegeneratePieces : public ::testing::TestWithParam<Degenerate> {
protected:
    Wall wall() const {
        for (const Fold& fold : kFolds)
            write(fold.name, {257, 193}, foldingOffsets(GetParam().sizePx, fold.scale));
        write("barrel", {33, 25}, onBarrel);
        write("flat", {5, 5}, onFlatScreen);
        return test::readWallOf(folder_, GetParam().projection, GetParam().sizePx, GetParam().eyeM);
    }

    test::TemporaryFolder folder_;

private:
    void write(const std::string& name, glm::ivec2 nodes, const test::NumbersAt& numbers) const {
        folder_.write(name + ".pfm", test::pfmBytes(mapOf(nodes, true, numbers)));
    }
};

TEST_P(DegeneratePieces, AreCertifiedAtEveryPixel) {
    const Wall degenerate = wall();
    const Display& display = degenerate.displays.front();
    for (const double tolerancePx : {1.0, 0.25}) {
        const FittedPieces fitted = fitPieces(display, tolerancePx);
        test::expectCertified(*display.projection, fitted, tolerancePx, 20'000);
        int holes = 0;
        for (int y = 0; y < display.sizePx.y; ++y)
            for (int x = 0; x < display.sizePx.x; ++x)
                holes += !display.projection->unproject({x + 0.5, y + 0.5});
        EXPECT_EQ(fitted.certificate.holes, holes);
    }
}

std::vector<Degenerate> degenerates() {
    constexpr glm::ivec2 kWidePx(240, 180), kSquarePx(200, 200);
    struct Gap {
        const char* name;
        double m;
    };
    std::vector<Degenerate> all;
    for (const auto& [gap, gapM] : {Gap{"_1mm", 1e-3}, {"_1um", 1e-6}, {"_1nm", 1e-9}}) {
        const glm::dvec3 barrel(glm::vec3(onBarrel({0.5, 0.5})));
        all.push_back({std::string("EyeAtACylinder") + gap, kFullCylinder, kWidePx, {2 - gapM, 0, 0}});
        all.push_back({std::string("EyeAtADome") + gap, onDome({}), kSquarePx, {0, 0, gapM - 4}});
        all.push_back(
            {std::string("EyeAtTheEdgeOfADome") + gap, onDome({0, 0, 3.999}), kSquarePx, {0, 4 - gapM, 0}});
        all.push_back({std::string("EyeAtABarrel") + gap, test::surfaceMap("barrel.pfm"), kWidePx,
                       barrel + glm::dvec3(0, 0, gapM)});
        all.push_back({std::string("EyeAtAMeasuredFlatScreen") + gap,
                       test::surfaceMap("flat.pfm"),
                       kWidePx,
                       {0.1, 0.2, -1 + gapM}});
    }
    for (const auto& [gap, gapM] : {Gap{"_1cm", 1e-2}, {"_1mm", 1e-3}, {"_100um", 1e-4}}) {
        all.push_back({std::string("EyeAtAFlatScreen") + gap, kFlatScreen, kWidePx, {0, 0, -1 + gapM}});
        all.push_back({std::string("FlatScreenEdgeOn") + gap, kFlatScreen, kWidePx, {3, 0.1, -1 + gapM}});
    }
    all.push_back({"CylinderFromFarAbove", with(kFullCylinder, {{"height", 1}}), kWidePx, {0, 1000, 0}});
    all.push_back({"CylinderInThePlaneOfTheEye", with(kFullCylinder, {{"height", 1e-6}}), kWidePx});
    all.push_back({"ThinArc", with(kFullCylinder, {{"arc_deg", 1e-3}}), kWidePx, {0, 0, -1.999}});
    all.push_back({"LensAtTheDome", onDome({0, 0, -3.999}), kSquarePx});
    for (const double fovDeg : {350.0, 359.9, 359.999})
        all.push_back({"Stereographic" + std::to_string(std::lround(1000 * fovDeg)),
                       fisheye("stereographic", fovDeg), kSquarePx});
    all.push_back({"Stereographic359900LargeDisplay", fisheye("stereographic", 359.9), {600, 600}});
    all.push_back({"StereographicWideAndLow", fisheye("stereographic", 359.9), {2000, 30}});
    all.push_back({"Equidistant360", fisheye("equidistant", 360), kSquarePx});
    all.push_back({"Equisolid360", fisheye("equisolid", 360), kSquarePx});
    all.push_back({"OrthographicToTheRim", fisheye("orthographic", 180), kSquarePx});
    all.push_back({"Curvilinear179", {{"type", "curvilinear"}, {"fov_deg", 179.9}}, kSquarePx});
    all.push_back({"PolynomialThatIsFlatAtTheRim",
                   with(fisheye("polynomial", 180), {{"coefficients", {1, 0, -0.1350949}}}), kSquarePx});
    all.push_back({"PinholeThatNearlyFolds",
                   {{"type", "camera"},
                    {"model", "pinhole"},
                    {"focal_px", {120, 120}},
                    {"principal_px", {120, 90}},
                    {"distortion", {-0.2, 0, 0, 0}}},
                   kWidePx});
    for (const Fold& fold : kFolds)
        for (const std::string direction : {"forward", "inverse"})
            all.push_back({fold.name + ("_" + direction),
                           test::cameraTexture(fold.name + std::string(".pfm"), direction), kWidePx});
    const json panorama = {
        {"type", "equirectangular"}, {"horizontal_fov_deg", 360}, {"vertical_fov_deg", 180}};
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {2, 2}, {1, 16384}, {16384, 1}}) {
        const std::string named = "_" + std::to_string(size.x) + "x" + std::to_string(size.y);
        all.push_back({"Cylinder" + named, kFullCylinder, size});
        all.push_back({"Fisheye" + named, fisheye("equidistant", 180), size});
        all.push_back({"Panorama" + named, panorama, size});
    }
    return all;
}

INSTANTIATE_TEST_SUITE_P(Displays, DegeneratePieces, ::testing::ValuesIn(degenerates()),
                         [](const auto& test) { return test.param.name; });

TEST(DegenerateDisplays, EyesThatCannotSeeTheScreenAreRefused) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(test::readWallOf(folder, kFlatScreen, {40, 30}, {0, 0, -1}), InputError);
    EXPECT_THROW(test::readWallOf(folder, kFlatScreen, {40, 30}, {5, 0, -1}), InputError);
    EXPECT_THROW(test::readWallOf(folder, kFullCylinder, {40, 30}, {2, 0, 0}), InputError);
    EXPECT_THROW(test::readWallOf(folder, onDome({}), {40, 30}, {4, 0, 0}), InputError);
    EXPECT_THROW(test::readWallOf(folder, fisheye("stereographic", 360), {40, 30}), InputError);
}

// The largest display that a wall file may name; at 8 bytes a pixel 2 GiB.
TEST(LargestDisplays, AreCertifiedAtEveryPixel) {
    constexpr glm::ivec2 kSizePx(16384, 16384);
    constexpr double kTolerancePx = 0.25;
    const test::TemporaryFolder folder;
    const Wall wall = test::readWallOf(folder, kFullCylinder, kSizePx);
    const Display& display = wall.displays.front();
    const FittedPieces fitted = fitPieces(display, kTolerancePx);
    test::expectCertified(*display.projection, fitted, kTolerancePx, 50'000);
    EXPECT_EQ(fitted.certificate.holes, 0);
    EXPECT_LE(fitted.mesh.pieces.size(), 300u);
}

TEST(LargestDisplays, AreCertifiedAtEveryPixelOfACurvedLens) {
    constexpr glm::ivec2 kSizePx(16384, 1024);
    constexpr double kTolerancePx = 1;
    const test::TemporaryFolder folder;
    const Wall wall = test::readWallOf(folder, {{"type", "curvilinear"}, {"fov_deg", 130}}, kSizePx);
    const Display& display = wall.displays.front();
    const FittedPieces fitted = fitPieces(display, kTolerancePx);
    test::expectCertified(*display.projection, fitted, kTolerancePx, 50'000);
    EXPECT_EQ(fitted.certificate.holes, 0);
}

class DegenerateRenders : public test::GlTest {};

// Facets that the eye sees nearly edge-on may lose single pixels to single precision: `mostUncovered`.
void expectDrawn(const Wall& wall, double shareOff, int mostUncovered) {
    const Display& display = wall.displays.front();
    RenderRequest request = test::requestFor(wall, loadScene("room"), {{0.4, 0.2, -0.3}, {0.3, 0.1, 0.2}});
    EXPECT_LE(test::differenceFromReference(request).shareOff, shareOff);
    request.output = OutputKind::coverage;
    const Frame coverage = Renderer().render(request).frame;
    int wrong = 0;
    for (int y = 0; y < display.sizePx.y; ++y)
        for (int x = 0; x < display.sizePx.x; ++x)
            wrong += *coverage.at(x, y) != (display.projection->unproject({x + 0.5, y + 0.5}) ? 1.0f : 0.0f);
    EXPECT_LE(wrong, mostUncovered);
}

TEST_F(DegenerateRenders, OfAStereographicViewOfNearlyEverything) {
    const test::TemporaryFolder folder;
    for (const double fovDeg : {359.0, 359.9})
        expectDrawn(test::readWallOf(folder, fisheye("stereographic", fovDeg), {160, 160}), 0.01, 0);
}

TEST_F(DegenerateRenders, FromAMillimetreBesideTheScreen) {
    const test::TemporaryFolder folder;
    const glm::ivec2 size(160, 120);
    expectDrawn(test::readWallOf(folder, kFullCylinder, size, {1.999, 0, 0}), 0.01, 0);
    expectDrawn(test::readWallOf(folder, kFlatScreen, size, {0.1, 0.2, -0.999}), 0.01, 0);
    expectDrawn(test::readWallOf(folder, kFlatScreen, size, {3, 0.1, -0.999}), 0.01, 0);
    const glm::dvec3 behindM(0, 0, 3.999);  // a dome about there begins right before the eye
    expectDrawn(test::readWallOf(folder, onDome(behindM, behindM), {160, 160}), 0.01, 0);
}

TEST_F(DegenerateRenders, OfAMapThatNearlyFolds) {
    const test::TemporaryFolder folder;
    const glm::ivec2 size(160, 120);
    for (const double scale : {0.01, 1e-5}) {
        folder.write("near.pfm", test::pfmBytes(mapOf({129, 97}, true, foldingOffsets(size, scale))));
        for (const char* direction : {"forward", "inverse"})
            expectDrawn(test::readWallOf(folder, test::cameraTexture("near.pfm", direction), size), 0.01, 2);
    }
}

}  // namespace
}  // namespace curvewall
