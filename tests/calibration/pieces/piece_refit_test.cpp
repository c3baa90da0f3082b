#include "calibration/pieces/piece_refit.h"

#include "calibration/errors.h"
#include "calibration/pieces/ownership.h"
#include "tests/support/random_numbers.h"
#include "tests/support/shipped_walls.h"
#include "tests/support/test_projections.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace curvewall {
namespace {

constexpr double kTolerancePx = 0.25;

// The largest error over every pixel, from scratch: where the ray meets the facet of the pixel's owner, as a
// blend of three corners. Infinite where a pixel with a ray has no owner.
double largestErrorPx(const Projection& projection, const FittedPieces& pieces) {
    double largest = 0;
    for (int y = 0; y < pieces.mesh.sizePx.y; ++y) {
        for (int x = 0; x < pieces.mesh.sizePx.x; ++x) {
            const auto ray = projection.unproject({x + 0.5, y + 0.5});
            const int32_t owner = (*pieces.owners)[static_cast<size_t>(y * pieces.mesh.sizePx.x + x)];
            EXPECT_EQ(owner == kNoPiece, !ray) << x << " " << y;
            if (!ray || owner == kNoPiece) continue;
            const Piece& piece = pieces.mesh.pieces[static_cast<size_t>(owner)];
            const auto corner = [&](size_t i) { return pieces.mesh.vertices[piece.vertices[i]]; };
            const glm::dvec3 blend = glm::inverse(glm::dmat3(corner(0).m, corner(1).m, corner(2).m)) * *ray;
            const glm::dvec2 px = (blend.x * corner(0).s + blend.y * corner(1).s + blend.z * corner(2).s) /
                                  (blend.x + blend.y + blend.z);
            largest = std::max(largest, glm::distance(px, {x + 0.5, y + 0.5}));
        }
    }
    return largest;
}

bool sameTopology(const PieceMesh& a, const PieceMesh& b) {
    return a.vertices.size() == b.vertices.size() &&
           std::ranges::equal(a.pieces, b.pieces, [](const Piece& p, const Piece& q) {
               return p.vertexCount == q.vertexCount && p.vertices == q.vertices;
           });
}

// How far neighbours are apart along the edges that they share, in pixels.
double largestGapPx(const PieceMesh& mesh, test::Random& random) {
    std::map<std::pair<uint32_t, uint32_t>, std::vector<const Piece*>> edges;
    for (const Piece& piece : mesh.pieces)
        for (uint32_t i = 0; i < piece.vertexCount; ++i)
            edges[std::minmax(piece.vertices[i], piece.vertices[(i + 1) % piece.vertexCount])].push_back(
                &piece);
    double largest = 0;
    for (const auto& [ends, pieces] : edges) {
        if (pieces.size() != 2) continue;
        const glm::dvec3 ray =
            glm::mix(mesh.vertices[ends.first].m, mesh.vertices[ends.second].m, random.uniform(0, 1));
        const glm::dvec3 a = pieces[0]->screenFromRay * ray, b = pieces[1]->screenFromRay * ray;
        largest = std::max(largest, glm::distance(glm::dvec2(a) / a.z, glm::dvec2(b) / b.z));
    }
    return largest;
}

// Vertices within an edge of a piece, where the edge's ends put them, and how far from there they are, as a
// share of their distance.
struct Hanging {
    uint32_t vertex, from, to;
};
double awayFromEdge(const PieceMesh& mesh, const Hanging& h) {
    const PieceVertex &v = mesh.vertices[h.vertex], &a = mesh.vertices[h.from], &b = mesh.vertices[h.to];
    const double share = glm::distance(v.s, a.s) / glm::distance(b.s, a.s);
    return glm::distance(v.m, glm::mix(a.m, b.m, share)) / glm::length(v.m);
}
std::vector<Hanging> hangingVertices(const PieceMesh& mesh) {
    std::vector<Hanging> found;
    for (const Piece& piece : mesh.pieces)
        for (uint32_t i = 0; i < piece.vertexCount; ++i)
            for (uint32_t v = 0; v < mesh.vertices.size(); ++v) {
                const Hanging h{v, piece.vertices[i], piece.vertices[(i + 1) % piece.vertexCount]};
                const glm::dvec2 s = mesh.vertices[v].s, a = mesh.vertices[h.from].s,
                                 b = mesh.vertices[h.to].s;
                const bool isWithin = glm::distance(s, a) > 0 && glm::distance(s, b) > 0 &&
                                      glm::distance(s, a) + glm::distance(s, b) == glm::distance(a, b);
                if (isWithin && awayFromEdge(mesh, h) < 1e-9) found.push_back(h);
            }
    return found;
}

struct Screen {
    std::string name;
    Wall wall;  // of one display
};
void PrintTo(const Screen& screen, std::ostream* out) { *out << screen.name; }

Wall onlyDisplay(Wall wall, size_t index) {
    wall.displays = {wall.displays[index]};
    return wall;
}

class RefitOfAScreen : public ::testing::TestWithParam<Screen> {
protected:
    const Wall& wall() const { return GetParam().wall; }
    Wall movedBy(glm::dvec3 byM) const { return seenFrom(wall(), wall().eyeM + byM); }
    const FittedPieces before_ = fitPieces(wall().displays[0], kTolerancePx);
};

TEST_P(RefitOfAScreen, ACentimetreKeepsTheTopology) {
    for (const glm::dvec3 byM : {glm::dvec3(0.01, 0, 0), glm::dvec3(0.005, 0.005, 0.007)}) {
        const Display now = movedBy(byM).displays[0];
        const FittedPieces sparse = refitPieces(before_, now, kTolerancePx, kSparseRows);
        EXPECT_TRUE(sameTopology(before_.mesh, sparse.mesh));
        EXPECT_EQ(sparse.certificate.every, 8);
        EXPECT_LE(sparse.certificate.maxPx, kTolerancePx);
        EXPECT_TRUE(sparse.errorsPx.empty());
        EXPECT_EQ(sparse.fullyCertifiedAt, before_.fullyCertifiedAt);

        const FittedPieces full = refitPieces(sparse, now, kTolerancePx, 1);
        EXPECT_EQ(full.certificate.every, 1);
        EXPECT_LE(full.certificate.maxPx, kTolerancePx);
        EXPECT_GT(full.fullyCertifiedAt, before_.fullyCertifiedAt);
        EXPECT_NEAR(largestErrorPx(*now.projection, full), full.certificate.maxPx, 1e-6);
    }
}

TEST_P(RefitOfAScreen, HalfAMetreMeetsTheToleranceToo) {
    const Display now = movedBy({0.3, 0.1, 0.4}).displays[0];
    const FittedPieces sparse = refitPieces(before_, now, kTolerancePx, kSparseRows);
    EXPECT_LE(sparse.certificate.maxPx, kTolerancePx);
    const FittedPieces full = refitPieces(sparse, now, kTolerancePx, 1);
    EXPECT_EQ(full.certificate.uncoveredPixels, 0);
    EXPECT_LE(largestErrorPx(*now.projection, full), kTolerancePx + 1e-6);
}

TEST_P(RefitOfAScreen, TheWayBackMeetsTheTolerance) {
    FittedPieces pieces = before_;
    for (const double xM : {0.05, 0.1, 0.05, 0.0})
        pieces = refitPieces(pieces, movedBy({xM, 0, 0}).displays[0], kTolerancePx, kSparseRows);
    pieces = refitPieces(pieces, movedBy({0, 0, 0}).displays[0], kTolerancePx, 1);
    EXPECT_LE(largestErrorPx(*wall().displays[0].projection, pieces), kTolerancePx + 1e-6);
    EXPECT_LE(pieces.mesh.pieces.size(), before_.mesh.pieces.size() * 11 / 10);
}

TEST_P(RefitOfAScreen, NeighboursGoOnAgreeing) {
    test::Random random(5);
    const std::vector<Hanging> hanging = hangingVertices(before_.mesh);
    for (const double xM : {0.01, 0.03}) {
        const FittedPieces after =
            refitPieces(before_, movedBy({xM, 0, 0}).displays[0], kTolerancePx, kSparseRows);
        ASSERT_TRUE(sameTopology(before_.mesh, after.mesh));
        EXPECT_LE(largestGapPx(after.mesh, random), 1e-9);
        for (const Hanging& h : hanging) EXPECT_LE(awayFromEdge(after.mesh, h), 1e-12);
    }
}

INSTANTIATE_TEST_SUITE_P(PieceRefit, RefitOfAScreen,
                         ::testing::Values(Screen{"Cylinder", test::fullCylinderWall({800, 600})},
                                           Screen{"MeasuredSurface", test::shippedWall("surface-map")},
                                           Screen{"DomeProjector",
                                                  onlyDisplay(test::shippedWall("five-projector-dome"), 0)}),
                         [](const auto& param) { return param.param.name; });

TEST(PieceRefit, OwnersAreSharedWhileScreenPositionsStay) {
    const Wall wall = test::shippedWall("surface-map");
    const FittedPieces before = fitPieces(wall.displays[0], kTolerancePx);
    const Wall moved = seenFrom(wall, wall.eyeM + glm::dvec3(0.01, 0, 0));
    const FittedPieces after = refitPieces(before, moved.displays[0], kTolerancePx, kSparseRows);
    EXPECT_EQ(after.owners, before.owners);
    EXPECT_EQ(after.basis, before.basis);
}

TEST(PieceRefit, DisplaysAtInfinityStayAsTheyAre) {
    const Wall wall = test::shippedWall("camera-texture");
    const FittedPieces before = fitPieces(wall.displays[0], 1);
    const Wall moved = seenFrom(wall, {3, 4, 5});
    const FittedPieces after = refitPieces(before, moved.displays[0], 1, kSparseRows);
    EXPECT_EQ(after.owners, before.owners);
    EXPECT_EQ(after.certificate.every, 1);
    EXPECT_EQ(after.fullyCertifiedAt, before.fullyCertifiedAt);
}

// A perspective picture that waves, shown within a circle or everywhere.
RayFunctionProjection wavingPicture(double phase, double radiusPx) {
    return RayFunctionProjection([=](glm::dvec2 px) -> std::optional<glm::dvec3> {
        if (glm::distance(px, {200, 150}) > radiusPx) return std::nullopt;
        const glm::dvec2 at = px / glm::dvec2(400, 300);
        const glm::dvec2 off = 0.04 * glm::dvec2(std::sin(6 * at.y + phase), std::cos(5 * at.x + phase));
        const glm::dvec2 base = at + off - 0.5;
        return glm::dvec3(base.x, -0.75 * base.y, -0.5);
    });
}

TEST(PieceRefit, FollowsAMapThatIsAnimated) {
    FittedPieces pieces = fitPieces(wavingPicture(0, 1e3), {400, 300}, kTolerancePx);
    const FittedPieces first = pieces;
    for (const double phase : {0.01, 0.02, 0.03}) {
        pieces = refitPieces(pieces, wavingPicture(phase, 1e3), kTolerancePx, kSparseRows);
        EXPECT_LE(pieces.certificate.maxPx, kTolerancePx);
    }
    EXPECT_TRUE(sameTopology(pieces.mesh, first.mesh));
    pieces = refitPieces(pieces, wavingPicture(1.5, 1e3), kTolerancePx, 1);
    EXPECT_LE(largestErrorPx(wavingPicture(1.5, 1e3), pieces), kTolerancePx + 1e-6);
}

TEST(PieceRefit, ADisplayThatBeginsOrCeasesToUnrollMeetsTheTolerance) {
    const PinholeProjection flat({400, 300}, 300);
    const RayFunctionProjection waving = wavingPicture(0, 1e3);
    const ProjectionPtr round = test::fullCylinderWall({400, 300}).displays[0].projection;
    for (const auto& [from, to] :
         {std::pair<const Projection&, const Projection&>{flat, waving}, {waving, flat}, {*round, waving}}) {
        const FittedPieces after =
            refitPieces(fitPieces(from, {400, 300}, kTolerancePx), to, kTolerancePx, 1);
        EXPECT_LE(largestErrorPx(to, after), kTolerancePx + 1e-6);
        for (const Piece& piece : after.mesh.pieces) {
            const auto vertex = [&](size_t i) { return after.mesh.vertices[piece.vertices[i]]; };
            EXPECT_TRUE(piece.vertexCount == 3 || isExactQuad(vertex(0), vertex(1), vertex(2), vertex(3)));
        }
    }
}

TEST(PieceRefit, FollowsAnOutlineThatGrowsAndShrinks) {
    const FittedPieces before = fitPieces(wavingPicture(0, 90), {400, 300}, kTolerancePx);
    for (const double radiusPx : {91.0, 60.0, 140.0}) {
        const RayFunctionProjection now = wavingPicture(0, radiusPx);
        EXPECT_LE(largestErrorPx(now, refitPieces(before, now, kTolerancePx, 1)), kTolerancePx + 1e-6);
    }
}

TEST(PieceRefit, WhatCannotBeFittedNamesTheDisplay) {
    Display display = pinholeWall({40, 30}, 30).displays[0];
    const FittedPieces before = fitPieces(display, kTolerancePx);
    display.projection = std::make_shared<RayFunctionProjection>([](glm::dvec2) { return std::nullopt; });
    try {
        refitPieces(before, display, kTolerancePx, kSparseRows);
        FAIL();
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find("display \"test\""), std::string::npos) << error.what();
    }
}

TEST(PieceRefit, StopsWhenNobodyWantsItAnyMore) {
    const Wall wall = test::fullCylinderWall({160, 120});
    const FittedPieces before = fitPieces(wall.displays[0], kTolerancePx);
    const Wall moved = seenFrom(wall, {0.1, 0, 0});
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(refitPieces(before, moved.displays[0], kTolerancePx, 1, stop.get_token()), FitStopped);
}

}  // namespace
}  // namespace curvewall
