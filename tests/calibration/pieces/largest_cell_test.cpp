#include "calibration/pieces/largest_cell.h"

#include "tests/support/broken_displays.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace curvewall {
namespace {

using test::kPi;

std::optional<ConvexCell> cellAt(const Projection& projection, glm::ivec2 sizePx, glm::dvec2 px,
                                 double tolerancePx, const PixelWeight& weight = {},
                                 glm::dvec2 stretch = {1, 0}) {
    return largestCell(projection, displayOutline(projection, sizePx), weight, px, tolerancePx, stretch);
}

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

double areaOf(const ConvexCell& cell) {
    double twice = 0;
    for (size_t k = 0; k < cell.corners.size(); ++k)
        twice += cross(cell.corners[k], cell.corners[(k + 1) % cell.corners.size()]);
    return twice / 2;
}

// Far closer than the search looks.
double largestErrorPx(const Projection& projection, const ConvexCell& cell) {
    glm::dvec2 middle(0);
    for (glm::dvec2 corner : cell.corners) middle += corner / double(cell.corners.size());
    double largest = 0;
    for (size_t k = 0; k < cell.corners.size(); ++k) {
        for (int i = 0; i < 400; ++i) {
            const glm::dvec2 edge = cell.corners[(k + 1) % cell.corners.size()] - cell.corners[k];
            const glm::dvec2 px =
                middle + (i / 20 / 19.0) * (cell.corners[k] + (i % 20 / 20.0) * edge - middle);
            const auto ray = projection.unproject(px);
            if (!ray) continue;
            const glm::dvec3 landing = cell.screenFromRay * *ray;
            if (!(landing.z > 0)) return INFINITY;
            largest = std::max(largest, glm::distance(glm::dvec2(landing) / landing.z, px));
        }
    }
    return largest;
}

TEST(LargestCell, IsConvexHasThePointAndMeetsTheTolerance) {
    const glm::ivec2 size(1024, 768);
    const RayFunctionProjection fisheye(test::fisheyeRays(size));
    test::Random random(5);
    int found = 0;
    for (int i = 0; i < 60; ++i) {
        const glm::dvec2 px(random.uniform(0, size.x), random.uniform(0, size.y));
        const double tolerancePx = std::exp(random.uniform(std::log(0.05), std::log(2)));
        const auto cell = cellAt(fisheye, size, px, tolerancePx);
        ASSERT_EQ(cell.has_value(), fisheye.unproject(px).has_value());
        if (!cell) continue;
        ++found;
        EXPECT_TRUE(cell->has(px));
        EXPECT_NEAR(cell->weight, areaOf(*cell), 1e-9 * cell->weight);
        EXPECT_LE(largestErrorPx(fisheye, *cell), 1.25 * tolerancePx);
        for (size_t k = 0; k < cell->corners.size(); ++k) {
            const auto corner = [&](size_t j) { return cell->corners[(k + j) % cell->corners.size()]; };
            EXPECT_GT(cross(corner(1) - corner(0), corner(2) - corner(1)), 0);
            EXPECT_LE(glm::distance(corner(0), 0.5 * glm::dvec2(size)), 0.5 * size.y + 1);
        }
    }
    EXPECT_GT(found, 20);
}

// At the middle of an equidistant fisheye the best homography is r = s tan(theta), which differs from
// r = c theta by c (theta^3 / 3 - d theta) where s = (1 - d) c: least where both extremes are equal, so a
// disc to theta = 2 cbrt(1.5 tolerance / c).
TEST(LargestCell, IsTheDiscThatTheoryGivesInTheMiddleOfAFisheye) {
    const glm::ivec2 size(2048, 2048);
    const RayFunctionProjection fisheye(test::fisheyeRays(size));
    const double c = 1024 / (kPi / 2);
    for (double tolerancePx : {0.1, 0.25, 0.5}) {
        const double radiusPx = c * 2 * std::cbrt(1.5 * tolerancePx / c);
        const auto cell = cellAt(fisheye, size, {1024, 1024}, tolerancePx);
        ASSERT_TRUE(cell);
        EXPECT_NEAR(cell->weight / (kPi * radiusPx * radiusPx), 1, 0.05) << tolerancePx;
    }
}

// With the axis in the middle of the display, at height y a cell may reach sqrt(2 k + 2 t / y) to both sides,
// in radii, where k is at most t over half the display's height. That is a half width of 2 sqrt(t / h) at the
// border for a strip; of all convex shapes in it the hexagon whose edges touch it half way up is largest, by
// sqrt(3 / 2).
TEST(LargestCell, IsTheHexagonThatTheoryGivesOnACylinder) {
    const glm::ivec2 size(1600, 1200);
    const Wall wall = test::fullCylinderWall(size);
    for (double tolerancePx : {0.1, 0.25, 0.5, 1.0}) {
        const double stripPx = 2 * std::sqrt(4 * tolerancePx / (size.y / 2)) * size.x / (2 * kPi);
        const auto cell = cellAt(*wall.displays[0].projection, size, {611, 500}, tolerancePx);
        ASSERT_TRUE(cell);
        EXPECT_NEAR(cell->weight / (stripPx * size.y), std::sqrt(1.5), 0.03) << tolerancePx;
    }
}

TEST(LargestCell, IsAllOfAFlatScreen) {
    const glm::ivec2 size(640, 480);
    const RayFunctionProjection flat(test::flatRays(size));
    const auto cell = cellAt(flat, size, {100, 300}, 0.01);
    ASSERT_TRUE(cell);
    EXPECT_NEAR(cell->weight / (640 * 480), 1, 0.01);
    // The integral of the eighth power.
    const auto weighty = cellAt(flat, size, {100, 300}, 0.01, {{0, 1}, 240, 240, 8});
    ASSERT_TRUE(weighty);
    EXPECT_NEAR(weighty->weight / (640 * 480 / 9.0), 1, 0.03);
}

TEST(LargestCell, StopsAtATear) {
    const glm::ivec2 size(640, 480);
    const auto torn = test::displaced(test::flatRays(size),
                                      [](glm::dvec2 px) { return glm::dvec2(0, px.x < 200 ? 0 : 100); });
    const auto cell = cellAt(RayFunctionProjection(torn), size, {400, 300}, 0.25);
    ASSERT_TRUE(cell);
    EXPECT_GE(std::ranges::min(cell->corners, {}, [](glm::dvec2 px) { return px.x; }).x, 199);
    EXPECT_GT(cell->weight, 0.8 * 440 * 480);
}

}  // namespace
}  // namespace curvewall
