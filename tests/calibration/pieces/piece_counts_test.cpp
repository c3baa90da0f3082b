// How the number of pieces goes with the tolerance, and what the fit saves against a uniform grid.

#include "calibration/pieces/piece_fit.h"
#include "calibration/projections/camera_texture.h"
#include "calibration/projections/frustum.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace curvewall {
namespace {

using test::kPi;

// The exponent of least squares in pieces ~ tolerance ^ exponent.
double exponentOf(const Projection& projection, glm::ivec2 sizePx, const std::vector<double>& tolerancesPx) {
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (const double tolerancePx : tolerancesPx) {
        const auto pieces =
            static_cast<double>(fitPieces(projection, sizePx, tolerancePx).mesh.pieces.size());
        const double logTolerance = std::log(tolerancePx), logPieces = std::log(pieces);
        n += 1;
        x += logTolerance;
        y += logPieces;
        xx += logTolerance * logTolerance;
        xy += logTolerance * logPieces;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

// Lorenz and Doellner's setting (2009, section 3.2): a view of 90 degrees and offsets of a twentieth of the
// display at 64 x 64 nodes.
CameraTexture bentCameraTexture(glm::ivec2 sizePx) {
    constexpr int kNodes = 64;
    NumberMap offsets{{kNodes, kNodes}, 2, false, {}};
    for (int j = 0; j < kNodes; ++j) {
        for (int i = 0; i < kNodes; ++i) {
            const double u = double(i) / (kNodes - 1), v = double(j) / (kNodes - 1);
            offsets.values.push_back(float(0.05 * sizePx.x * std::sin(2 * kPi * u) * std::sin(kPi * v)));
            offsets.values.push_back(float(0.05 * sizePx.y * std::sin(kPi * u) * std::sin(2 * kPi * v)));
        }
    }
    const double up = std::atan(double(sizePx.y) / sizePx.x);
    return {std::make_shared<GridMap>(std::move(offsets), NodeMeaning{.isOffset = true}, sizePx,
                                      Alignment::corners),
            std::make_shared<FrustumProjection>(Frustum{-kPi / 4, kPi / 4, -up, up, {}}, sizePx),
            MapDirection::forward};
}

// (N + 1)^2 points of the base plane at equal steps, where the map takes them, in two triangles a cell.
PieceMesh uniformTriangles(const CameraTexture& projection, glm::ivec2 sizePx, int cells) {
    PieceGrid grid{sizePx, cells, cells, {}};
    const double up = double(sizePx.y) / sizePx.x;
    for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) {
            const glm::dvec3 base(2.0 * i / cells - 1, up * (1 - 2.0 * j / cells), -1);
            grid.vertices.push_back({base, snapToGrid(projection.project(base).at(0))});
        }
    }
    return meshFromGrid(grid, false);
}

TEST(PieceCounts, GrowWithTheInverseRootOfTheToleranceOnACylinder) {
    const glm::ivec2 sizePx(800, 600);
    const double exponent = exponentOf(*test::fullCylinderWall(sizePx).displays[0].projection, sizePx,
                                       {1, 0.5, 0.25, 0.125, 0.0625, 0.03125});
    EXPECT_NEAR(exponent, -0.5, 0.02);
}

TEST(PieceCounts, GrowWithTheInverseOfTheToleranceOnACurvedMap) {
    const glm::ivec2 sizePx(960, 400);
    const LensProjection curvilinear(curvilinearLens(130 * kPi / 180, sizePx), {});
    EXPECT_NEAR(exponentOf(curvilinear, sizePx, {1, 0.5, 0.25, 0.125, 0.0625}), -1, 0.1);
}

// The pieces along the rim are as many as the rim is long, so a part of them grows with the inverse root.
TEST(PieceCounts, GrowAlmostWithTheInverseOfTheToleranceOnARoundFisheye) {
    const glm::ivec2 sizePx(1024, 1024);
    const LensProjection fisheye(circularLens({}, kPi, sizePx), {});
    const double exponent = exponentOf(fisheye, sizePx, {1, 0.5, 0.25, 0.125});
    EXPECT_LT(exponent, -0.8);
    EXPECT_GT(exponent, -1.1);
}

TEST(PieceCounts, GrowWithTheInverseOfTheToleranceOnACameraTexture) {
    const glm::ivec2 sizePx(800, 600);
    EXPECT_NEAR(exponentOf(bentCameraTexture(sizePx), sizePx, {2, 1, 0.5, 0.25}), -1, 0.2);
}

TEST(PieceCounts, ACameraTextureTakesFarFewerThanAUniformGrid) {
    constexpr double kTolerancePx = 0.5;
    const glm::ivec2 sizePx(1600, 1200);
    const CameraTexture projection = bentCameraTexture(sizePx);
    const auto largestErrorPx = [&](int cells) {
        return certifyPieces(projection, uniformTriangles(projection, sizePx, cells)).certificate.maxPx;
    };
    int cells = 1;
    while (largestErrorPx(cells) > kTolerancePx) ++cells;
    const auto pieces = static_cast<double>(fitPieces(projection, sizePx, kTolerancePx).mesh.pieces.size());
    EXPECT_GE(2.0 * cells * cells, 2.5 * pieces);
}

}  // namespace
}  // namespace curvewall
