#include "calibration/pieces/lower_bound.h"

#include "calibration/pieces/piece_fit.h"
#include "tests/support/broken_displays.h"
#include "tests/support/shipped_walls.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

namespace curvewall {
namespace {

using test::kPi;

double boundOf(const Wall& wall, double tolerancePx) {
    return lowerBoundOfPieces(*wall.displays[0].projection, wall.displays[0].sizePx, tolerancePx);
}

double boundOf(test::RayAt rays, glm::ivec2 sizePx, double tolerancePx) {
    return lowerBoundOfPieces(RayFunctionProjection(std::move(rays)), sizePx, tolerancePx);
}

TEST(LowerBound, AFlatScreenNeedsOnePiece) {
    EXPECT_EQ(boundOf(test::planarWall({1600, 1200}, 100), 0.01), 1);
    EXPECT_EQ(boundOf(test::planarWall({1, 1}, 100), 0.01), 1);
    EXPECT_EQ(boundOf([](glm::dvec2) { return std::nullopt; }, {64, 48}, 0.5), 1);
}

// Strips of full height are 2 sqrt(4 t / h) radii wide, h being half the display's height.
TEST(LowerBound, ComesNearTheStripsOfACylinder) {
    const glm::ivec2 size(1600, 1200);
    const Wall wall = test::fullCylinderWall(size);
    for (double tolerancePx : {1.0, 0.5, 0.25, 0.1}) {
        const double strips = kPi / std::sqrt(4 * tolerancePx / (size.y / 2));
        const double bound = boundOf(wall, tolerancePx);
        EXPECT_LE(bound, strips) << tolerancePx;
        EXPECT_GE(bound, 0.93 * strips) << tolerancePx;
    }
}

TEST(LowerBound, GrowsWithTheInverseOfTheToleranceWhereADisplayIsCurvedBothWays) {
    const test::RayAt rays = test::fisheyeRays({2048, 2048});
    EXPECT_NEAR(boundOf(rays, {2048, 2048}, 0.125) / boundOf(rays, {2048, 2048}, 0.5), 4, 0.3);
}

TEST(LowerBound, DependsOnTheSizeOnlyThroughTheTolerance) {
    EXPECT_NEAR(boundOf(test::fisheyeRays({512, 512}), {512, 512}, 0.125) /
                    boundOf(test::fisheyeRays({8192, 8192}), {8192, 8192}, 2),
                1, 0.01);
    EXPECT_NEAR(
        boundOf(test::fullCylinderWall({400, 300}), 0.1) / boundOf(test::fullCylinderWall({6400, 4800}), 1.6),
        1, 0.01);
}

class ShippedWalls : public testing::TestWithParam<std::string> {};

TEST_P(ShippedWalls, HaveNotFewerPiecesThanTheBound) {
    constexpr double kTolerancePx = 1;
    for (const Display& display : test::shippedWall(GetParam()).displays) {
        const double bound = lowerBoundOfPieces(*display.projection, display.sizePx, kTolerancePx);
        EXPECT_GE(bound, 1);
        EXPECT_LE(bound, static_cast<double>(fitPieces(display, kTolerancePx).mesh.pieces.size()))
            << display.name;
    }
}

INSTANTIATE_TEST_SUITE_P(LowerBound, ShippedWalls, testing::ValuesIn(test::shippedWallNames()),
                         [](const auto& wall) {
                             std::string name = wall.param;
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

struct BrokenDisplay {
    std::string name;
    test::RayAt rays;
};

void PrintTo(const BrokenDisplay& display, std::ostream* out) { *out << display.name; }

constexpr glm::ivec2 kBrokenSize(160, 120);

std::vector<BrokenDisplay> brokenDisplays() {
    const test::RayAt flat = test::flatRays(kBrokenSize), fisheye = test::fisheyeRays(kBrokenSize);
    const auto tear = [](glm::dvec2 px) { return glm::dvec2(px.x < 71 ? 0 : 9, px.y < 33 ? 0 : 7); };
    const auto wave = [](glm::dvec2 px) {
        return 8.0 * glm::dvec2(std::sin(px.y / 15), std::cos(px.x / 11));
    };
    const auto noise = [](glm::dvec2 px) {
        return 0.8 * glm::dvec2(test::noiseAt(px, 1), test::noiseAt(px, 2));
    };
    return {{"Torn", test::displaced(flat, tear)},
            {"TornFisheye", test::displaced(fisheye, tear)},
            {"Folded", test::displaced(flat, wave)},
            {"Noisy", test::displaced(flat, noise)},
            {"Random", test::randomRays()},
            {"Striped", test::withHoles(fisheye, [](glm::dvec2 px) { return std::fmod(px.x, 16) < 5; })},
            {"Sparse",
             test::withHoles(flat,
                             [](glm::dvec2 px) {
                                 return std::fmod(std::floor(px.x), 4) + std::fmod(std::floor(px.y), 3) > 0;
                             })},
            {"OneRay", [](glm::dvec2) { return glm::dvec3(0, 0, -1); }},
            {"OnePlane", [](glm::dvec2 px) { return glm::dvec3(px.x - 80, 0, -80); }},
            {"Pole", [](glm::dvec2 px) {
                 const double longitude = px.x / 160 * 2 * kPi, latitude = (0.5 - px.y / 120) * kPi;
                 return glm::dvec3(std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                                   -std::cos(latitude) * std::cos(longitude));
             }}};
}

class BrokenDisplays : public testing::TestWithParam<BrokenDisplay> {};

TEST_P(BrokenDisplays, HaveNotFewerPiecesThanTheBound) {
    for (double tolerancePx : {2.0, 0.25}) {
        const double bound = boundOf(GetParam().rays, kBrokenSize, tolerancePx);
        EXPECT_GE(bound, 1);
        const FittedPieces fitted =
            fitPieces(RayFunctionProjection(GetParam().rays), kBrokenSize, tolerancePx);
        EXPECT_LE(bound, static_cast<double>(fitted.mesh.pieces.size())) << tolerancePx;
    }
}

INSTANTIATE_TEST_SUITE_P(LowerBound, BrokenDisplays, testing::ValuesIn(brokenDisplays()),
                         [](const auto& display) { return display.param.name; });

}  // namespace
}  // namespace curvewall
