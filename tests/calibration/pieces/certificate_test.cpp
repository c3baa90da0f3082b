#include "calibration/pieces/certificate.h"

#include "calibration/pieces/ownership.h"
#include "tests/support/random_numbers.h"
#include "tests/support/test_projections.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

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
        const Certificate certificate = certifyPieces(*wall.displays[0].projection, mesh).certificate;
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
    EXPECT_TRUE(std::isinf(certifyPieces(*wall.displays[0].projection, mesh).certificate.maxPx));
}

// Says which pixels it was asked for.
class WatchedProjection : public Projection {
public:
    WatchedProjection(const Projection& watched, glm::ivec2 sizePx)
        : watched_(watched), sizePx_(sizePx), asked_(static_cast<size_t>(sizePx.x * sizePx.y)) {}

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override {
        const glm::ivec2 at(glm::floor(px));
        ++asked_.at(static_cast<size_t>(at.y * sizePx_.x + at.x));
        return watched_.unproject(px);
    }
    std::vector<glm::dvec2> project(glm::dvec3) const override { return {}; }
    ProjectionPtr seenFrom(glm::dvec3) const override { return nullptr; }

    int asked(int x, int y) const { return asked_.at(static_cast<size_t>(y * sizePx_.x + x)); }

private:
    const Projection& watched_;
    glm::ivec2 sizePx_;
    mutable std::vector<std::atomic<int>> asked_;
};

TEST(Certificate, OverEveryNthRowAndColumnTouchesNoOtherPixel) {
    const glm::ivec2 sizePx(61, 47);
    const Wall wall = test::fullCylinderWall(sizePx);
    const PieceMesh mesh = inscribedSlices(*wall.displays[0].projection, sizePx, 12);
    const CertifiedPixels all = certifyPieces(*wall.displays[0].projection, mesh);
    EXPECT_EQ(all.certificate.every, 1);
    for (const int every : {1, 2, 8, 100}) {
        const WatchedProjection watched(*wall.displays[0].projection, sizePx);
        const CertifiedPixels some = certifyPieces(watched, mesh, {}, every);
        EXPECT_EQ(some.certificate.every, every);
        std::vector<int32_t> owners;
        std::vector<float> errorsPx;
        for (int y = 0; y < sizePx.y; ++y) {
            for (int x = 0; x < sizePx.x; ++x) {
                const bool isLooked = x % every == 0 && y % every == 0;
                EXPECT_EQ(watched.asked(x, y), isLooked ? 1 : 0);
                if (!isLooked) continue;
                owners.push_back(all.owners[static_cast<size_t>(y * sizePx.x + x)]);
                errorsPx.push_back(all.errorsPx[static_cast<size_t>(y * sizePx.x + x)]);
            }
        }
        EXPECT_EQ(some.owners, owners);
        EXPECT_EQ(some.errorsPx, errorsPx);
        const glm::ivec2 at = some.certificate.maxAt;
        EXPECT_EQ(some.certificate.maxPx, all.errorsPx[static_cast<size_t>(at.y * sizePx.x + at.x)]);
        EXPECT_EQ(some.certificate.maxPx, *std::ranges::max_element(errorsPx));
    }
}

TEST(Certificate, ThePercentileIsTheElementOfThatRank) {
    test::Random random(1);
    for (const size_t count : {1u, 2u, 100u, 101u, 5000u}) {
        std::vector<float> errors;
        for (size_t i = 0; i < count; ++i)
            errors.push_back(i % 7 == 3 ? 0.25f : static_cast<float>(std::exp(random.uniform(-20, 1))));
        const std::vector<int32_t> owners(count, 0);
        const Certificate certificate = certificateOf(errors, owners, {static_cast<int>(count), 1});
        std::ranges::sort(errors);
        EXPECT_EQ(certificate.p99Px, errors[static_cast<size_t>(0.99 * static_cast<double>(count - 1))]);
        EXPECT_EQ(certificate.maxPx, errors.back());
    }
}

TEST(Certificate, HolesAndPixelsWithoutAPieceAreToldApart) {
    const glm::ivec2 sizePx(16, 12);
    const Wall wall = test::planarWall(sizePx, 90);
    PieceMesh mesh = inscribedSlices(*wall.displays[0].projection, sizePx, 4);
    mesh.pieces.erase(mesh.pieces.begin());
    const RayFunctionProjection withHole([&](glm::dvec2 px) -> std::optional<glm::dvec3> {
        if (px.x < 1 || px.x > 15) return std::nullopt;
        return wall.displays[0].projection->unproject(px);
    });
    const CertifiedPixels pixels = certifyPieces(withHole, mesh);
    EXPECT_EQ(pixels.certificate.holes, 2 * 12);
    EXPECT_EQ(pixels.certificate.uncoveredPixels, 3 * 12);
    EXPECT_TRUE(std::isnan(pixels.errorsPx[0]) && std::isnan(pixels.errorsPx[15]));
    EXPECT_TRUE(std::isinf(pixels.errorsPx[1]));
    EXPECT_EQ(pixels.owners[0], kNoPiece);
    EXPECT_EQ(pixels.owners[15], kNoPiece);
    EXPECT_LT(pixels.certificate.maxPx, 1e-9);
}

}  // namespace
}  // namespace curvewall
