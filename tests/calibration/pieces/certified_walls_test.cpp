// Every wall that ships at every tolerance that matters: certified over all of its pixels, and the
// certificate measured again. About two minutes of one core.

#include "tests/support/certificate_checks.h"
#include "tests/support/shipped_walls.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <utility>

namespace curvewall {
namespace {

using WallAndTolerance = std::tuple<std::string, double>;

// What is promised for these.
const std::map<WallAndTolerance, size_t> kMostPiecesOf{{{"full-cylinder", 0.5}, 56},
                                                       {{"full-cylinder", 0.25}, 80},
                                                       {{"dome-master", 0.5}, 2000},
                                                       {{"dome-master", 0.25}, 4000}};

class CertifiedWalls : public ::testing::TestWithParam<WallAndTolerance> {};

// The other way round: the display has the ray that a pixel shows within the same error, to first order.
// Borders of a full turn are one place.
double shownFromPx(const Display& display, const FittedPieces& fitted, glm::ivec2 px) {
    const size_t i =
        static_cast<size_t>(px.y) * static_cast<size_t>(display.sizePx.x) + static_cast<size_t>(px.x);
    const glm::dvec2 centre = glm::dvec2(px) + 0.5;
    const Piece& piece = fitted.mesh.pieces[static_cast<size_t>((*fitted.owners)[i])];
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec2 at : display.projection->project(test::shownRay(fitted.mesh, piece, centre))) {
        const glm::dvec2 off = glm::abs(at - centre);
        nearest =
            std::min({nearest, glm::length(off), glm::length(glm::dvec2(display.sizePx.x - off.x, off.y))});
    }
    return nearest;
}

// What is shown beside a hole may come from beyond the map.
bool isBesideAHole(const Projection& projection, glm::ivec2 px) {
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx)
            if (!projection.unproject(glm::dvec2(px) + glm::dvec2(dx + 0.5, dy + 0.5))) return true;
    return false;
}

void expectRaysFromNearby(const Display& display, const FittedPieces& fitted, double mostPx) {
    constexpr int kPixels = 3000;
    test::Random random(2);
    double worstPx = 0;
    for (int k = 0; k < kPixels; ++k) {
        const glm::ivec2 px(random.pixel(display.sizePx));
        if (!isBesideAHole(*display.projection, px))
            worstPx = std::max(worstPx, shownFromPx(display, fitted, px));
    }
    EXPECT_LE(worstPx, mostPx);
}

TEST_P(CertifiedWalls, MeetTheToleranceAtEveryPixel) {
    const auto& [name, tolerancePx] = GetParam();
    for (const Display& display : test::shippedWall(name).displays) {
        SCOPED_TRACE(display.name);
        const FittedPieces fitted = fitPieces(display, tolerancePx);
        test::expectCertified(*display.projection, fitted, tolerancePx, 10'000);
        test::expectExactPieces(fitted.mesh);
        if (const auto most = kMostPiecesOf.find(GetParam()); most != kMostPiecesOf.end()) {
            EXPECT_LE(fitted.mesh.pieces.size(), most->second);
        }
        expectRaysFromNearby(display, fitted, 1.05 * tolerancePx);
    }
}

std::string nameOf(const ::testing::TestParamInfo<WallAndTolerance>& test) {
    std::string name = std::get<0>(test.param) + "_" + std::to_string(int(1000 * std::get<1>(test.param)));
    std::ranges::replace(name, '-', '_');
    return name + "_mpx";
}

INSTANTIATE_TEST_SUITE_P(Shipped, CertifiedWalls,
                         ::testing::Combine(::testing::ValuesIn(test::shippedWallNames()),
                                            ::testing::Values(1.0, 0.5, 0.25, 0.1)),
                         nameOf);

}  // namespace
}  // namespace curvewall
