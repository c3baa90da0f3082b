#include "calibration/pieces/cell_fit.h"

#include "calibration/errors.h"
#include "calibration/pieces/ownership.h"
#include "calibration/pieces/piece_fit.h"
#include "tests/support/broken_displays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <pthread.h>
#include <sched.h>
#include <set>
#include <thread>
#include <utility>

namespace curvewall {
namespace {

FittedPieces fit(test::RayAt rays, glm::ivec2 sizePx, double tolerancePx) {
    return fitPieces(RayFunctionProjection(std::move(rays)), sizePx, tolerancePx);
}

void expectCertified(const FittedPieces& fitted, const test::RayAt& rayAt, double tolerancePx) {
    const FunctionRays rays(rayAt, fitted.mesh.sizePx);
    const std::vector<int32_t> owners = ownerImage(fitted.mesh);
    double largest = 0;
    for (int y = 0; y < fitted.mesh.sizePx.y; ++y) {
        for (int x = 0; x < fitted.mesh.sizePx.x; ++x) {
            const auto i = static_cast<size_t>(y * fitted.mesh.sizePx.x + x);
            ASSERT_EQ((*fitted.owners)[i], rays.has({x, y}) ? owners[i] : kNoPiece);
            if (!rays.has({x, y})) continue;
            ASSERT_NE(owners[i], kNoPiece);
            const glm::dvec3 h =
                fitted.mesh.pieces[static_cast<size_t>(owners[i])].screenFromRay * rays.at({x, y});
            ASSERT_GT(h.z, 0);
            largest = std::max(largest, glm::distance(glm::dvec2(h) / h.z, centreOf({x, y})));
        }
    }
    EXPECT_LE(largest, tolerancePx);
    EXPECT_NEAR(largest, fitted.certificate.maxPx, 1e-6);
    EXPECT_EQ(fitted.certificate.uncoveredPixels, 0);
}

TEST(CellFit, AFisheyeTakesFewPieces) {
    for (const auto& [sidePx, mostPieces] : {std::pair{1024, 1400u}, {2048, 2600u}}) {
        const test::RayAt rays = test::fisheyeRays(glm::ivec2(sidePx));
        const FittedPieces fitted = fit(rays, glm::ivec2(sidePx), 0.5);
        EXPECT_LE(fitted.mesh.pieces.size(), mostPieces);
        expectCertified(fitted, rays, 0.5);
    }
}

// Edges between two pieces, as pairs of places. A long edge counts as the parts that its hanging vertices
// make.
TEST(CellFit, ASmoothDisplayIsOneMeshWithoutLooseEdges) {
    const auto bent = [](glm::dvec2 px) {
        const double azimuth = (px.x / 320 - 0.5) * 2, elevation = (0.5 - px.y / 240) * 1.5;
        return glm::dvec3(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                          -std::cos(elevation) * std::cos(azimuth));
    };
    const PieceMesh mesh = fit(bent, {320, 240}, 0.25).mesh;
    EXPECT_GT(mesh.pieces.size(), 50u);
    // Each place has one vertex, so pieces that meet there share it; and the pieces tile the display, so all
    // edges inside have two sides.
    std::set<std::pair<double, double>> places;
    for (const PieceVertex& vertex : mesh.vertices) places.insert({vertex.s.x, vertex.s.y});
    EXPECT_EQ(places.size(), mesh.vertices.size());

    std::vector<uint32_t> parent(mesh.pieces.size());
    for (uint32_t k = 0; k < parent.size(); ++k) parent[k] = k;
    const auto rootOf = [&](uint32_t k) {
        while (parent[k] != k) k = parent[k] = parent[parent[k]];
        return k;
    };
    std::map<uint32_t, uint32_t> firstAt;
    for (uint32_t k = 0; k < mesh.pieces.size(); ++k)
        for (uint32_t i = 0; i < mesh.pieces[k].vertexCount; ++i) {
            const auto [entry, isNew] = firstAt.try_emplace(mesh.pieces[k].vertices[i], k);
            parent[rootOf(k)] = rootOf(entry->second);
        }
    std::set<uint32_t> parts;
    for (uint32_t k = 0; k < parent.size(); ++k) parts.insert(rootOf(k));
    EXPECT_EQ(parts.size(), 1u);
}

TEST(CellFit, TheSameDisplayGetsTheSamePiecesFromAnyNumberOfThreads) {
    const test::RayAt rays = test::withHoles(test::fisheyeRays({256, 256}),
                                             [](glm::dvec2 px) { return test::noiseAt(px, 1) < 0.1; });
    const PieceMesh first = fit(rays, {256, 256}, 0.5).mesh, again = fit(rays, {256, 256}, 0.5).mesh;
    PieceMesh onOneCore;
    std::thread([&] {
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(sched_getcpu(), &one);
        pthread_setaffinity_np(pthread_self(), sizeof one, &one);
        onOneCore = fit(rays, {256, 256}, 0.5).mesh;
    }).join();
    for (const PieceMesh* other : {&std::as_const(again), &std::as_const(onOneCore)}) {
        ASSERT_EQ(first.vertices.size(), other->vertices.size());
        ASSERT_EQ(first.pieces.size(), other->pieces.size());
        for (size_t i = 0; i < first.vertices.size(); ++i) {
            ASSERT_EQ(first.vertices[i].m, other->vertices[i].m);
            ASSERT_EQ(first.vertices[i].s, other->vertices[i].s);
        }
        for (size_t k = 0; k < first.pieces.size(); ++k)
            ASSERT_EQ(first.pieces[k].vertices, other->pieces[k].vertices);
    }
}

struct Broken {
    const char* name;
    glm::ivec2 sizePx;
    test::RayAt rays;
};

// So that names show in ctest, and not bytes.
void PrintTo(const Broken& broken, std::ostream* out) { *out << broken.name; }

class CellFitBroken : public ::testing::TestWithParam<Broken> {};

TEST_P(CellFitBroken, IsCertifiedAtEveryPixel) {
    for (const double tolerancePx : {1.0, 0.25}) {
        const FittedPieces fitted = fit(GetParam().rays, GetParam().sizePx, tolerancePx);
        expectCertified(fitted, GetParam().rays, tolerancePx);
    }
}

constexpr glm::ivec2 kSizePx(192, 160);
test::RayAt jittered(double byPx) {
    return test::displaced(test::flatRays(kSizePx), [byPx](glm::dvec2 px) {
        return byPx * glm::dvec2(2 * test::noiseAt(px, 2) - 1, 2 * test::noiseAt(px, 3) - 1);
    });
}
test::RayAt rippled(double periodPx, double byPx) {
    return test::displaced(test::flatRays(kSizePx), [=](glm::dvec2 px) {
        return glm::dvec2(byPx * std::sin(6.283 * px.x / periodPx) * std::cos(6.283 * px.y / periodPx));
    });
}
bool isOddPixel(glm::dvec2 px) { return (static_cast<int>(px.x) + static_cast<int>(px.y)) % 2 == 1; }
glm::dvec2 blockOf(glm::dvec2 px, double sidePx) { return glm::floor(px / sidePx); }

// The slowest take about half a second each.
INSTANTIATE_TEST_SUITE_P(
    Displays, CellFitBroken,
    ::testing::Values(
        Broken{"Fisheye", kSizePx, test::fisheyeRays(kSizePx)},
        Broken{"FlatCheckerboardOfHoles", kSizePx, test::withHoles(test::flatRays(kSizePx), isOddPixel)},
        Broken{"FisheyeCheckerboardOfHoles", kSizePx,
               test::withHoles(test::fisheyeRays(kSizePx), isOddPixel)},
        Broken{"FisheyeRandomHoles", kSizePx,
               test::withHoles(test::fisheyeRays(kSizePx),
                               [](glm::dvec2 px) { return test::noiseAt(px, 4) < 0.4; })},
        Broken{"FisheyeIslands", kSizePx,
               test::withHoles(test::fisheyeRays(kSizePx),
                               [](glm::dvec2 px) { return test::noiseAt(blockOf(px, 8), 5) < 0.5; })},
        Broken{"FewPixels", kSizePx,
               test::withHoles(test::fisheyeRays(kSizePx),
                               [](glm::dvec2 px) { return test::noiseAt(px, 6) < 0.98; })},
        Broken{"RandomRays", kSizePx, test::randomRays()},
        Broken{"OneRay", kSizePx, [](glm::dvec2) { return glm::dvec3(0.3, 0.2, -1); }},
        Broken{"OneRayAColumn", kSizePx, [](glm::dvec2 px) { return glm::dvec3(px.x / 96 - 1, 0.2, -1); }},
        Broken{"JitterOfHalfTheTolerance", kSizePx, jittered(0.5)},
        Broken{"JitterOfAboutTheTolerance", kSizePx, jittered(1.1)},
        Broken{"JitterOfManyPixels", kSizePx, jittered(20)},
        Broken{"RipplesOfThreePixels", kSizePx, rippled(3, 1.1)},
        Broken{"RipplesOfSevenPixels", kSizePx, rippled(7, 10)},
        Broken{"RipplesOfThirtyPixels", kSizePx, rippled(31, 2)},
        Broken{"StepsInColumns", kSizePx,
               test::displaced(test::flatRays(kSizePx),
                               [](glm::dvec2 px) { return glm::dvec2(20 * (int(px.x / 5) % 2), 0); })},
        Broken{"ShuffledBlocks", kSizePx,
               test::displaced(test::flatRays(kSizePx),
                               [](glm::dvec2 px) {
                                   return 90.0 * glm::dvec2(test::noiseAt(blockOf(px, 8), 7),
                                                            test::noiseAt(blockOf(px, 8), 8));
                               })},
        Broken{"WideAndLow",
               {4096, 8},
               test::displaced(test::flatRays({4096, 8}),
                               [](glm::dvec2 px) {
                                   return glm::dvec2(2 * std::sin(0.1 * px.x), std::cos(0.3 * px.x + px.y));
                               })},
        Broken{"NarrowAndHigh",
               {8, 4096},
               test::displaced(test::flatRays({8, 4096}),
                               [](glm::dvec2 px) { return glm::dvec2(0, 2 * std::sin(0.7 * px.y)); })},
        Broken{"NoiseOnNinePixels", {3, 3}, test::randomRays()},
        Broken{"OnePixel", {1, 1}, test::randomRays()},
        Broken{"OneColumnOfNoise", {1, 2000}, test::randomRays()}),
    [](const auto& broken) { return std::string(broken.param.name); });

TEST(CellFit, AToleranceThatTakesTooManyPiecesIsRefused) {
    EXPECT_THROW(fit(test::randomRays(), {512, 384}, 1), UsageError);
    EXPECT_THROW(fit(test::fisheyeRays({700, 700}), {700, 700}, 1e-4), UsageError);
}

TEST(CellFit, AToleranceFinerThanRoundingIsRefusedOrMet) {
    const test::RayAt rays = test::fisheyeRays({32, 32});
    for (const double tolerancePx : {1e-9, 1e-12, 1e-15, 1e-300}) {
        try {
            EXPECT_LE(fit(rays, {32, 32}, tolerancePx).certificate.maxPx, tolerancePx);
        } catch (const UsageError&) {
        }
    }
}

TEST(CellFit, ADisplayWithoutARayIsRefused) {
    EXPECT_THROW(fit([](glm::dvec2) { return std::nullopt; }, {16, 16}, 1), UsageError);
}

}  // namespace
}  // namespace curvewall
