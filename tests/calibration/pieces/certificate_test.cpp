#include "calibration/pieces/certificate.h"

#include "calibration/pieces/ownership.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

#include <cmath>

namespace curvewall {
namespace {

using test::kPi;

// Slices of equal width with their vertices on the wall, as in Lorenz and Doellner (2009), section 3.1.
PieceMesh inscribedSlices(const Projection& projection, glm::ivec2 sizePx, int count) {
    std::vector<PieceVertex> vertices;
    for (int row = 0; row < 2; ++row)
        for (int i = 0; i <= count; ++i) {
            const glm::dvec2 s = snapToGrid({double(sizePx.x) * i / count, double(sizePx.y) * row});
            vertices.push_back({*projection.unproject(s), s});
        }
    const PieceGrid grid{sizePx, count, 1, std::move(vertices)};
    return meshFromGrid(grid, isQuadGrid(grid));
}

TEST(Certificate, InscribedSlicesErrAsTheirSagittaSays) {
    // A ray to the middle of a slice meets the facet at cos(half the slice's angle) of the distance to the
    // wall, so heights shrink by that factor: at the border rows by (599.5 px) (1 - cos(pi / N)). No pixel
    // centre need lie just in the middle: half a pixel beside it, in a slice of 16 px, takes 0.4 % off.
    const glm::ivec2 sizePx(1600, 1200);
    const Wall wall = test::fullCylinderWall(sizePx);
    for (int count : {32, 50, 100}) {
        const PieceMesh mesh = inscribedSlices(*wall.displays[0].projection, sizePx, count);
        ASSERT_EQ(mesh.pieces.size(), static_cast<size_t>(count)) << "slices are exact quads";
        const std::vector<int32_t> owners = ownerImage(mesh);
        const auto errors =
            pieceErrorsPx(RayImage(*wall.displays[0].projection, wall.displays[0].sizePx), mesh, owners);
        const Certificate certificate = certificateOf(errors, owners, sizePx);
        EXPECT_NEAR(certificate.maxPx, 599.5 * (1 - std::cos(kPi / count)), 5e-3 * certificate.maxPx);
        EXPECT_TRUE(certificate.maxAt.y == 0 || certificate.maxAt.y == 1199);
        EXPECT_EQ(certificate.uncoveredPixels, 0);
        EXPECT_EQ(certificate.holes, 0);
        EXPECT_LE(certificate.meanPx, certificate.p99Px);
        EXPECT_LE(certificate.p99Px, certificate.maxPx);
    }
}

TEST(Certificate, FiguresAreThoseOfTheErrorImage) {
    const std::vector<float> errors{1, 3, 2, NAN, INFINITY, 4};
    const std::vector<int32_t> owners{0, 0, 0, 0, kNoPiece, 0};
    const Certificate certificate = certificateOf(errors, owners, {3, 2});
    EXPECT_EQ(certificate.maxPx, 4);
    EXPECT_EQ(certificate.meanPx, 2.5);
    EXPECT_EQ(certificate.maxAt, glm::ivec2(2, 1));
    EXPECT_EQ(certificate.holes, 1);
    EXPECT_EQ(certificate.uncoveredPixels, 1);
}

TEST(Certificate, AFacetThatTurnsItsBackIsInfinitelyWrong) {
    const glm::ivec2 sizePx(16, 12);
    const Wall wall = test::planarWall(sizePx, 90);
    PieceMesh mesh = inscribedSlices(*wall.displays[0].projection, sizePx, 1);
    for (Piece& piece : mesh.pieces) piece.screenFromRay = -piece.screenFromRay;
    const std::vector<int32_t> owners = ownerImage(mesh);
    const auto errors =
        pieceErrorsPx(RayImage(*wall.displays[0].projection, wall.displays[0].sizePx), mesh, owners);
    EXPECT_TRUE(std::isinf(certificateOf(errors, owners, sizePx).maxPx));
}

}  // namespace
}  // namespace curvewall
