#include "calibration/pieces/cell_facets.h"

#include "calibration/pieces/ownership.h"
#include "tests/support/broken_displays.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

constexpr glm::ivec2 kSizePx(64, 48);

FunctionRays imageOf(test::RayAt rays, glm::ivec2 sizePx = kSizePx) { return {std::move(rays), sizePx}; }

TEST(CellFacets, APlaneIsFoundFromAnyCellOfAFlatScreen) {
    const FunctionRays rays = imageOf(test::flatRays(kSizePx));
    test::Random random(2);
    for (int i = 0; i < 200; ++i) {
        Cell cell;
        for (int axis : {0, 1}) {
            cell.fromPx[axis] = static_cast<int>(random.uniform(0, kSizePx[axis]));
            cell.toPx[axis] = cell.fromPx[axis] + 1 +
                              static_cast<int>(random.uniform(0, kSizePx[axis] - cell.fromPx[axis]));
            cell.toPx[axis] = std::min(cell.toPx[axis], kSizePx[axis]);
        }
        const CellFacets facets = facetsOf(rays, cell);
        ASSERT_FALSE(facets.isEmpty);
        EXPECT_LT(facets.errorPx, 1e-3) << cell.sizePx().x << " x " << cell.sizePx().y;
    }
}

TEST(CellFacets, APlaneIsFoundThroughHoles) {
    const FunctionRays rays = imageOf(
        test::withHoles(test::flatRays(kSizePx), [](glm::dvec2 px) { return test::noiseAt(px, 1) < 0.7; }));
    for (int x = 0; x < 64; x += 16) EXPECT_LT(facetsOf(rays, {{x, 0}, {x + 16, 48}}).errorPx, 1e-3);
}

TEST(CellFacets, ACellWithoutARayIsEmptyAndOneRayIsEnough) {
    const FunctionRays rays = imageOf(
        test::withHoles(test::flatRays(kSizePx), [](glm::dvec2 px) { return px != glm::dvec2(13.5, 7.5); }));
    EXPECT_TRUE(facetsOf(rays, {{16, 0}, {32, 48}}).isEmpty);
    const CellFacets facets = facetsOf(rays, {{0, 0}, {16, 48}});  // no lattice meets it
    EXPECT_FALSE(facets.isEmpty);
    EXPECT_EQ(facets.pixelCount, 1);
    EXPECT_LT(facets.errorPx, 1e-9);
}

TEST(CellFacets, TheErrorIsThatOfTheWorstPixel) {
    // A flat screen but for one pixel, which is 3 px off.
    const FunctionRays rays = imageOf(test::displaced(test::flatRays(kSizePx), [](glm::dvec2 px) {
        return px == glm::dvec2(0.5, 0.5) ? glm::dvec2(3, 0) : glm::dvec2(0);
    }));
    const FunctionRays flat = imageOf(test::flatRays(kSizePx));
    const Cell cell{{0, 0}, {64, 48}};
    const auto corners = facetsOf(flat, cell).corners;
    for (const bool falling : {true, false})
        EXPECT_NEAR(facetErrorPx(rays, cell, corners, falling, latticePixels(rays, cell, 64)), 3, 1e-6);
}

TEST(CellFacets, LatticesHaveTheOutermostPixels) {
    const FunctionRays rays = imageOf(test::flatRays(kSizePx));
    const std::vector<SeenPixel> pixels = latticePixels(rays, {{10, 5}, {41, 8}}, 5);
    EXPECT_EQ(pixels.size(), 15u);
    for (const glm::ivec2 corner : {glm::ivec2(10, 5), {40, 5}, {10, 7}, {40, 7}})
        EXPECT_NE(std::ranges::find(pixels, corner, &SeenPixel::px), pixels.end());
}

TEST(CellFacets, TheFacetOfAPixelIsItsOwner) {
    for (const glm::ivec2 size : {glm::ivec2(16, 16), {7, 30}, {1, 1}, {12, 5}}) {
        for (const bool falling : {true, false}) {
            const Cell cell{{0, 0}, size};
            PieceMesh mesh;
            mesh.sizePx = size;
            for (glm::ivec2 corner : cornersOf(cell))
                mesh.vertices.push_back({glm::dvec3(corner, 1), corner});
            for (const auto& corners : facetCorners(falling))
                mesh.pieces.push_back({{corners[0], corners[1], corners[2], 0}, 3});
            const std::vector<int32_t> owners = ownerImage(mesh);
            for (int y = 0; y < size.y; ++y) {
                for (int x = 0; x < size.x; ++x) {
                    // On the diagonal either may be it: they agree there.
                    const glm::dvec2 at = (glm::dvec2(x, y) + 0.5) / glm::dvec2(size);
                    if ((falling ? at.x - at.y : at.x + at.y - 1) == 0) continue;
                    ASSERT_EQ(static_cast<size_t>(owners[static_cast<size_t>(y * size.x + x)]),
                              facetAt(cell, falling, {x, y}));
                }
            }
        }
    }
}

TEST(CellFacets, CutsGoAcrossTheBend) {
    // A cylinder with its axis upright bends along x, one that lies bends along y.
    const auto upright = [](glm::dvec2 px) {
        const double angle = (px.x / 64 - 0.5) * 2;
        return glm::dvec3(std::sin(angle), 0.5 - px.y / 48, -std::cos(angle));
    };
    EXPECT_EQ(bestCut(imageOf(upright), {{0, 0}, {64, 48}}).axis, 0);
    const auto lying = [](glm::dvec2 px) {
        const double angle = (px.y / 48 - 0.5) * 2;
        return glm::dvec3(px.x / 64 - 0.5, -std::sin(angle), -std::cos(angle));
    };
    EXPECT_EQ(bestCut(imageOf(lying), {{0, 0}, {64, 48}}).axis, 1);
    EXPECT_EQ(bestCut(imageOf(lying), {{0, 0}, {64, 1}}).axis, 0);
    EXPECT_EQ(bestCut(imageOf(lying), {{5, 5}, {6, 6}}).axis, -1);
}

}  // namespace
}  // namespace curvewall
