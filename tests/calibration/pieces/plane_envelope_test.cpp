#include "calibration/pieces/plane_envelope.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace curvewall {
namespace {

constexpr glm::ivec2 kSizePx(640, 400);

// Tangents of a paraboloid that opens downwards, at random places: each is the lowest around its place.
std::vector<HeightPlane> randomTangents(int count, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> x(0, kSizePx.x), y(0, kSizePx.y);
    std::vector<HeightPlane> planes;
    for (int i = 0; i < count; ++i) {
        const glm::dvec2 at(x(random), y(random)), slope = -2.0 * at;
        planes.push_back({glm::dot(at, at), slope});
    }
    return planes;
}

double area(const PlaneEnvelope& envelope, const std::vector<uint32_t>& cell) {
    double twice = 0;
    for (size_t i = 0; i < cell.size(); ++i) {
        const glm::dvec2 a = envelope.corners[cell[i]], b = envelope.corners[cell[(i + 1) % cell.size()]];
        twice += a.x * b.y - a.y * b.x;
    }
    return 0.5 * twice;
}

bool contains(const PlaneEnvelope& envelope, const std::vector<uint32_t>& cell, glm::dvec2 px) {
    for (size_t i = 0; i < cell.size(); ++i) {
        const glm::dvec2 a = envelope.corners[cell[i]], b = envelope.corners[cell[(i + 1) % cell.size()]];
        if ((b.x - a.x) * (px.y - a.y) - (b.y - a.y) * (px.x - a.x) < -1e-6) return false;
    }
    return !cell.empty();
}

TEST(PlaneEnvelope, CellsTileTheDisplay) {
    for (int count : {1, 2, 3, 4, 5, 50, 500}) {
        const PlaneEnvelope envelope = lowestPlanes(randomTangents(count, 7), kSizePx);
        double sum = 0;
        for (const std::vector<uint32_t>& cell : envelope.cells) {
            if (cell.empty()) continue;
            EXPECT_GT(area(envelope, cell), 0);
            sum += area(envelope, cell);
        }
        EXPECT_NEAR(sum, double(kSizePx.x) * kSizePx.y, 1e-5) << count;
    }
}

TEST(PlaneEnvelope, EachCellIsWhereItsPlaneIsTheLowest) {
    const std::vector<HeightPlane> planes = randomTangents(300, 11);
    const PlaneEnvelope envelope = lowestPlanes(planes, kSizePx);
    std::mt19937 random(12);
    std::uniform_real_distribution<double> x(0, kSizePx.x), y(0, kSizePx.y);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec2 px(x(random), y(random));
        const auto lowest =
            std::ranges::min_element(planes, {}, [&](const HeightPlane& p) { return p.at(px); });
        EXPECT_TRUE(contains(envelope, envelope.cells[size_t(lowest - planes.begin())], px))
            << px.x << ", " << px.y;
    }
}

TEST(PlaneEnvelope, NeighboursShareTheirCorners) {
    const PlaneEnvelope envelope = lowestPlanes(randomTangents(300, 13), kSizePx);
    std::vector<int> uses(envelope.corners.size());
    for (const std::vector<uint32_t>& cell : envelope.cells)
        for (uint32_t corner : cell) ++uses[corner];
    for (size_t i = 0; i < uses.size(); ++i) {
        const glm::dvec2 px = envelope.corners[i];
        const bool isInside = px.x > 0 && px.y > 0 && px.x < kSizePx.x && px.y < kSizePx.y;
        if (isInside) {
            EXPECT_GE(uses[i], 3) << px.x << ", " << px.y;
        }
    }
}

TEST(PlaneEnvelope, APlaneAboveTheOthersHasNoCell) {
    std::vector<HeightPlane> planes = randomTangents(20, 17);
    planes.push_back({1e9, {0, 0}});
    EXPECT_TRUE(lowestPlanes(planes, kSizePx).cells.back().empty());
}

TEST(PlaneEnvelope, FourPlanesThroughOnePointMeetInOneCorner) {
    const std::vector<HeightPlane> planes{
        {0, {1, 0}}, {320 * 2, {-1, 0}}, {320 - 200, {0, 1}}, {320 + 200, {0, -1}}, {1e9, {0, 0}}};
    const PlaneEnvelope envelope = lowestPlanes(planes, kSizePx);
    const auto isMiddle = [](glm::dvec2 px) { return glm::distance(px, glm::dvec2(320, 200)) < 1e-6; };
    EXPECT_EQ(std::ranges::count_if(envelope.corners, isMiddle), 1);
}

TEST(PlacesPx, TellApartWhatRoundingDoesNotMake) {
    PlacesPx places;
    EXPECT_EQ(places.numberOf({10, 20}), 0u);
    EXPECT_EQ(places.numberOf({10 + 1e-11, 20 - 1e-11}), 0u);
    EXPECT_EQ(places.numberOf({10 + 1e-7, 20}), 1u);
    EXPECT_EQ(places.all().size(), 2u);
}

}  // namespace
}  // namespace curvewall
