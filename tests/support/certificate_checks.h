#pragma once
// A certificate measured again at random pixels, by plain geometry.

#include "calibration/pieces/ownership.h"
#include "calibration/pieces/piece_fit.h"
#include "tests/support/piece_geometry.h"
#include "tests/support/random_numbers.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace curvewall::test {

// Owners are decided between vertices on the 1/256 px grid: that much an edge may be from where it is drawn.
inline constexpr double kEdgeDoubtPx = 1.5 * kSnapPx;

// At one pixel: it has an owner just where it has a ray, the owner contains its centre, no later piece does,
// and its error is what was noted. Gives the error, or nothing in a hole.
inline std::optional<double> expectCertifiedAt(const Projection& projection, const FittedPieces& fitted,
                                               const ScreenBuckets& buckets, glm::ivec2 px) {
    const PieceMesh& mesh = fitted.mesh;
    const size_t i = static_cast<size_t>(px.y) * static_cast<size_t>(mesh.sizePx.x) + size_t(px.x);
    const glm::dvec2 centre = glm::dvec2(px) + 0.5;
    const auto ray = projection.unproject(centre);
    const int32_t owner = (*fitted.owners)[i];
    EXPECT_EQ(owner != kNoPiece, ray.has_value()) << px.x << ", " << px.y;
    if (!ray || owner == kNoPiece) return std::nullopt;

    const Piece& piece = mesh.pieces[static_cast<size_t>(owner)];
    EXPECT_GT(depthInside(mesh, piece, centre), -kEdgeDoubtPx) << px.x << ", " << px.y;
    for (uint32_t k : buckets.at(centre))
        if (depthInside(mesh, mesh.pieces[k], centre) > kEdgeDoubtPx) {
            EXPECT_LE(static_cast<int32_t>(k), owner) << px.x << ", " << px.y;
        }
    const double errorPx = glm::distance(landing(mesh, piece, *ray), centre);
    EXPECT_NEAR(errorPx, fitted.errorsPx[i], 1e-5) << px.x << ", " << px.y;
    return errorPx;
}

inline void expectCertified(const Projection& projection, const FittedPieces& fitted, double tolerancePx,
                            int pixelCount) {
    const Certificate& certificate = fitted.certificate;
    EXPECT_LE(certificate.maxPx, tolerancePx);
    EXPECT_EQ(certificate.uncoveredPixels, 0);

    const ScreenBuckets buckets = piecesByPlace(fitted.mesh);
    const auto worst = expectCertifiedAt(projection, fitted, buckets, certificate.maxAt);
    ASSERT_TRUE(worst.has_value());
    EXPECT_NEAR(*worst, certificate.maxPx, 1e-5);
    Random random(1);
    for (int i = 0; i < pixelCount && !::testing::Test::HasFailure(); ++i) {
        const glm::ivec2 px(random.pixel(fitted.mesh.sizePx));
        EXPECT_LE(expectCertifiedAt(projection, fitted, buckets, px).value_or(0), certificate.maxPx + 1e-5)
            << px.x << ", " << px.y;
    }
}

// Every piece is convex, and one affine map from its points to its screen positions. A triangle always is,
// but for what rounding loses on facets that are seen nearly edge-on.
inline void expectExactPieces(const PieceMesh& mesh) {
    double worstTrianglePx = 0, worstPolygonPx = 0, worstOutside = 0;
    for (const Piece& piece : mesh.pieces) {
        ASSERT_GE(piece.vertexCount, 3u);
        ASSERT_LE(piece.vertexCount, kMostPieceEdges);
        for (size_t i = 0; i < piece.vertexCount; ++i) {
            const PieceVertex& corner = cornerOf(mesh, piece, i);
            const glm::dvec3 seen = piece.screenFromRay * corner.m;
            double& worstPx = piece.vertexCount == 3 ? worstTrianglePx : worstPolygonPx;
            worstPx = std::max(worstPx, glm::distance(glm::dvec2(seen) / seen.z, corner.s));
            worstOutside = std::max(worstOutside, -depthInside(mesh, piece, corner.s));
        }
    }
    EXPECT_LT(worstTrianglePx, 1e-6);
    EXPECT_LT(worstPolygonPx, 1e-9);
    EXPECT_LT(worstOutside, 1e-9);
}

}  // namespace curvewall::test
