#include "calibration/pieces/piece_fit.h"

#include "calibration/errors.h"
#include "calibration/pieces/ownership.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace curvewall {
namespace {

using test::kPi;

FittedPieces fit(const Wall& wall, double tolerancePx) {
    return fitPieces(*wall.displays[0].projection, wall.displays[0].sizePx, tolerancePx);
}

// The certificate once more, from scratch and without the code that made it.
double largestErrorPx(const Wall& wall, const FittedPieces& fitted) {
    const Display& display = wall.displays[0];
    double largest = 0;
    for (int y = 0; y < display.sizePx.y; ++y) {
        for (int x = 0; x < display.sizePx.x; ++x) {
            const int32_t owner = (*fitted.owners)[static_cast<size_t>(y * display.sizePx.x + x)];
            if (owner == kNoPiece) return INFINITY;
            const Piece& piece = fitted.mesh.pieces[static_cast<size_t>(owner)];
            const auto corner = [&](size_t i) { return fitted.mesh.vertices[piece.vertices[i]]; };
            // Where the ray meets the facet's plane, as a blend of three corners.
            const glm::dvec3 ray = *display.projection->unproject({x + 0.5, y + 0.5});
            const glm::dvec3 blend = glm::inverse(glm::dmat3(corner(0).m, corner(1).m, corner(2).m)) * ray;
            const glm::dvec2 px = (blend.x * corner(0).s + blend.y * corner(1).s + blend.z * corner(2).s) /
                                  (blend.x + blend.y + blend.z);
            largest = std::max(largest, glm::distance(px, {x + 0.5, y + 0.5}));
        }
    }
    return largest;
}

void expectCertified(const Wall& wall, const FittedPieces& fitted, double tolerancePx) {
    EXPECT_LE(fitted.certificate.maxPx, tolerancePx);
    EXPECT_EQ(fitted.certificate.uncoveredPixels, 0);
    EXPECT_EQ(fitted.certificate.holes, 0);
    EXPECT_NEAR(largestErrorPx(wall, fitted), fitted.certificate.maxPx, 1e-6);
}

TEST(PieceFit, FullCylinderNeedsFewQuadsOfFullHeight) {
    const Wall wall = test::fullCylinderWall({1600, 1200});
    for (const auto& [tolerancePx, mostPieces] : {std::pair{0.5, 60u}, {0.25, 84u}}) {
        const FittedPieces fitted = fit(wall, tolerancePx);
        expectCertified(wall, fitted, tolerancePx);
        EXPECT_LE(fitted.mesh.pieces.size(), mostPieces);
        for (const Piece& piece : fitted.mesh.pieces) {
            ASSERT_EQ(piece.vertexCount, 4u);
            EXPECT_EQ(fitted.mesh.vertices[piece.vertices[0]].s.y, 0);
            EXPECT_EQ(fitted.mesh.vertices[piece.vertices[2]].s.y, 1200);
            EXPECT_TRUE(isExactQuad(
                fitted.mesh.vertices[piece.vertices[0]], fitted.mesh.vertices[piece.vertices[1]],
                fitted.mesh.vertices[piece.vertices[2]], fitted.mesh.vertices[piece.vertices[3]]));
        }
    }
}

TEST(PieceFit, PiecesGrowWithTheInverseRootOfTheTolerance) {
    const Wall wall = test::fullCylinderWall({800, 600});
    const double coarse = static_cast<double>(fit(wall, 0.4).mesh.pieces.size());
    const double fine = static_cast<double>(fit(wall, 0.1).mesh.pieces.size());
    EXPECT_NEAR(fine / coarse, 2, 0.15);
}

TEST(PieceFit, AFlatScreenIsOnePieceWithoutError) {
    const Wall wall = test::planarWall({640, 480}, 120);
    const FittedPieces fitted = fit(wall, 0.001);
    EXPECT_EQ(fitted.mesh.pieces.size(), 1u);
    EXPECT_LT(fitted.certificate.maxPx, 1e-9);
}

TEST(PieceFit, TolerancesThatNothingCanMeetAreRefused) {
    const Wall wall = test::fullCylinderWall({160, 120});
    for (double tolerancePx : {0.0, -1.0, double(NAN), double(INFINITY)})
        EXPECT_THROW(fit(wall, tolerancePx), UsageError);
    EXPECT_THROW(fit(wall, 1e-12), UsageError);
}

TEST(PieceFit, WhatIsRefusedNamesTheDisplay) {
    const Wall wall = test::fullCylinderWall({160, 120});
    try {
        fitPieces(wall.displays[0], 1e-12);
        FAIL() << "not refused";
    } catch (const UsageError& error) {
        EXPECT_EQ(std::string(error.what()).rfind("display \"front\": a tolerance of 1e-12 px needs more", 0),
                  0u)
            << error.what();
    }
}

TEST(PieceFit, AFlatScreenAskedForLessThanRoundingIsRefusedOrMet) {
    // More cells do not help a display that does not bend; the search has to end all the same.
    const Wall wall = test::planarWall({160, 120}, 170);
    try {
        EXPECT_LE(fit(wall, 1e-15).certificate.maxPx, 1e-15);
    } catch (const UsageError&) {
    }
}

TEST(PieceFit, AWallSeenFromFarAboveKeepsItsQuads) {
    // The homographies of such facets are badly conditioned; that they are parallelograms is not in doubt.
    const Wall wall = test::fullCylinderWall({160, 120}, {0, 1000, 0});
    const FittedPieces fitted = fit(wall, 0.25);
    EXPECT_LE(fitted.certificate.maxPx, 0.25);
    for (const Piece& piece : fitted.mesh.pieces) EXPECT_EQ(piece.vertexCount, 4u);
}

class PieceFitWalls : public ::testing::TestWithParam<Wall> {};

TEST_P(PieceFitWalls, MeetTheToleranceAtEveryPixel) {
    for (double tolerancePx : {1.0, 0.25, 0.05}) {
        const FittedPieces fitted = fit(GetParam(), tolerancePx);
        expectCertified(GetParam(), fitted, tolerancePx);
    }
}

TEST_P(PieceFitWalls, FacetsAllTurnTheSameSideToTheEye) {
    const FittedPieces fitted = fit(GetParam(), 0.5);
    for (const Piece& piece : fitted.mesh.pieces) {
        const auto m = [&](size_t i) { return fitted.mesh.vertices[piece.vertices[i]].m; };
        // From the top left to the top right and down: clockwise for the eye, so the volume is positive.
        EXPECT_GT(glm::determinant(glm::dmat3(m(0), m(1), m(2))), 0);
    }
}

TEST_P(PieceFitWalls, TheSameWallGetsTheSamePieces) {
    const FittedPieces first = fit(GetParam(), 0.25), second = fit(GetParam(), 0.25);
    ASSERT_EQ(first.mesh.vertices.size(), second.mesh.vertices.size());
    for (size_t i = 0; i < first.mesh.vertices.size(); ++i) {
        EXPECT_EQ(first.mesh.vertices[i].m, second.mesh.vertices[i].m);
        EXPECT_EQ(first.mesh.vertices[i].s, second.mesh.vertices[i].s);
    }
}

const CylinderWall kTiltedArc{3, 220 * kPi / 180, 3, {0.2, 0.1, -0.3}, {0.5, 0.2, 0.1}};
const CylinderWall kSliver{2, 1 * kPi / 180, 3, {}, {}};
INSTANTIATE_TEST_SUITE_P(Cylinders, PieceFitWalls,
                         ::testing::Values(test::fullCylinderWall({800, 600}),
                                           test::fullCylinderWall({800, 600}, {1.8, 0, 0}),
                                           test::fullCylinderWall({800, 600}, {-0.4, 1.5, 1.6}),
                                           test::cylinderWall(kTiltedArc, {0.7, 0.6, 0.9}, {960, 540}),
                                           test::cylinderWall(kSliver, {1.9, 0, 0}, {64, 480}),
                                           test::fullCylinderWall({16, 12})),
                         [](const auto& wall) { return "Wall" + std::to_string(wall.index); });

}  // namespace
}  // namespace curvewall
