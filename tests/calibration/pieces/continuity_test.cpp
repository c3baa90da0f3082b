// Neighbouring pieces agree along the edges that they share, whichever vertices they have there.

#include "calibration/pieces/piece_fit.h"
#include "tests/support/piece_geometry.h"
#include "tests/support/random_numbers.h"
#include "tests/support/shipped_walls.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace curvewall {
namespace {

constexpr double kCollinearPx = 1e-6;  // two edges closer than that are one
constexpr double kShortPx = 1e-3;      // edges that share less only touch
// Pieces that are further apart at the ends of their common edge were never joined.
constexpr double kTornPx = 1e-2;

struct Edge {
    uint32_t piece;
    glm::dvec2 from, to;
};

// A stretch of the screen along which two pieces meet.
struct SharedEdge {
    uint32_t one, other;
    glm::dvec2 from, to;

    double lengthPx() const { return glm::distance(from, to); }
};

std::vector<Edge> edgesOf(const PieceMesh& mesh) {
    std::vector<Edge> edges;
    for (uint32_t k = 0; k < mesh.pieces.size(); ++k)
        for (size_t i = 0; i < mesh.pieces[k].vertexCount; ++i)
            edges.push_back({k, test::cornerOf(mesh, mesh.pieces[k], i).s,
                             test::cornerOf(mesh, mesh.pieces[k], i + 1).s});
    return edges;
}

// What two edges have in common, if they run along one line.
std::optional<SharedEdge> overlapOf(const Edge& a, const Edge& b) {
    const Edge &longer = glm::distance(a.from, a.to) >= glm::distance(b.from, b.to) ? a : b,
               &shorter = &longer == &a ? b : a;
    const double length = glm::distance(longer.from, longer.to);
    const glm::dvec2 along = (longer.to - longer.from) / length;
    double begin = length, end = 0;
    for (const glm::dvec2 px : {shorter.from, shorter.to}) {
        if (std::abs(test::cross2(along, px - longer.from)) > kCollinearPx) return std::nullopt;
        const double at = std::clamp(glm::dot(along, px - longer.from), 0.0, length);
        begin = std::min(begin, at);
        end = std::max(end, at);
    }
    if (end - begin < kShortPx) return std::nullopt;
    return SharedEdge{a.piece, b.piece, longer.from + begin * along, longer.from + end * along};
}

// Found by place alone, each once.
std::vector<SharedEdge> sharedEdges(const PieceMesh& mesh) {
    const std::vector<Edge> edges = edgesOf(mesh);
    test::ScreenBuckets buckets(mesh.sizePx, test::bucketSidePx(mesh));
    for (uint32_t i = 0; i < edges.size(); ++i)
        buckets.add(i, glm::min(edges[i].from, edges[i].to) - kCollinearPx,
                    glm::max(edges[i].from, edges[i].to) + kCollinearPx);
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    for (const std::vector<uint32_t>& near : buckets.all())
        for (size_t i = 0; i < near.size(); ++i)
            for (size_t j = i + 1; j < near.size(); ++j)
                if (edges[near[i]].piece != edges[near[j]].piece)
                    pairs.emplace_back(std::minmax(near[i], near[j]));
    std::ranges::sort(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    std::vector<SharedEdge> shared;
    for (const auto& [i, j] : pairs)
        if (const auto overlap = overlapOf(edges[i], edges[j])) shared.push_back(*overlap);
    return shared;
}

// Where one piece lands what the other shows at a place, from there.
double apartPx(const PieceMesh& mesh, uint32_t shown, uint32_t landed, glm::dvec2 px) {
    const glm::dvec3 ray = glm::inverse(mesh.pieces[shown].screenFromRay) * glm::dvec3(px, 1);
    const glm::dvec3 h = mesh.pieces[landed].screenFromRay * ray;
    return h.z > 0 ? glm::distance(glm::dvec2(h) / h.z, px) : std::numeric_limits<double>::infinity();
}

bool isTorn(const PieceMesh& mesh, const SharedEdge& edge) {
    return std::max(apartPx(mesh, edge.one, edge.other, edge.from),
                    apartPx(mesh, edge.one, edge.other, edge.to)) > kTornPx;
}

// As scene.vert has it: three rows of H to clip space and a ray, all in single precision. `fma` is up to the
// compiler of the shader and changes less than a rounding.
glm::dvec2 gpuLanding(const PieceMesh& mesh, uint32_t piece, glm::vec3 ray) {
    const glm::dvec2 size(mesh.sizePx);
    const glm::dmat3 clipFromScreen(2 / size.x, 0, 0, 0, 2 / size.y, 0, -1, -1, 1);
    const glm::dmat3 rows = glm::transpose(clipFromScreen * mesh.pieces[piece].screenFromRay);
    const float x = glm::dot(glm::vec3(rows[0]), ray), y = glm::dot(glm::vec3(rows[1]), ray);
    const float w = glm::dot(glm::vec3(rows[2]), ray);
    const glm::vec2 ndc(x / w, y / w);
    return (0.5f * ndc + 0.5f) * glm::vec2(size);
}

struct Apart {
    double exactPx = 0, roundedPx = 0, floatPx = 0;
};

Apart mostApart(const PieceMesh& mesh, const std::vector<SharedEdge>& edges, int points, uint64_t seed) {
    test::Random random(seed);
    Apart most;
    for (int i = 0; i < points; ++i) {
        const SharedEdge& edge =
            edges[static_cast<size_t>(random.uniform(0, static_cast<double>(edges.size())))];
        const glm::dvec2 px = glm::mix(edge.from, edge.to, random.uniform(0, 1));
        const glm::dvec2 rounded = snapToGrid(px);
        most.exactPx = std::max(most.exactPx, apartPx(mesh, edge.one, edge.other, px));
        most.roundedPx = std::max(most.roundedPx, apartPx(mesh, edge.one, edge.other, rounded));
        const glm::vec3 ray(glm::inverse(mesh.pieces[edge.one].screenFromRay) * glm::dvec3(px, 1));
        most.floatPx = std::max(
            most.floatPx, glm::distance(gpuLanding(mesh, edge.one, ray), gpuLanding(mesh, edge.other, ray)));
    }
    return most;
}

struct JoinedPieces {
    PieceMesh mesh;
    std::vector<SharedEdge> all, joined;
    double tornShare = 0;  // of the length of all
};

JoinedPieces joinedPieces(const std::string& wallName, const std::string& displayName) {
    constexpr double kTolerancePx = 0.5;
    const Wall wall = test::shippedWall(wallName);
    JoinedPieces pieces{fitPieces(findDisplay(wall, displayName), kTolerancePx).mesh, {}, {}};
    pieces.all = sharedEdges(pieces.mesh);
    double lengthPx = 0, tornPx = 0;
    for (const SharedEdge& edge : pieces.all) {
        lengthPx += edge.lengthPx();
        if (isTorn(pieces.mesh, edge))
            tornPx += edge.lengthPx();
        else
            pieces.joined.push_back(edge);
    }
    pieces.tornShare = tornPx / lengthPx;
    return pieces;
}

// Pieces that meet somewhere are neighbours by sharedEdges too: a look just across random edges.
void expectAllNeighboursFound(const PieceMesh& mesh, const std::vector<SharedEdge>& shared) {
    constexpr int kLooks = 20'000;
    constexpr double kAcrossPx = 0.02, kClearPx = 1e-3;
    std::set<std::pair<uint32_t, uint32_t>> neighbours;
    for (const SharedEdge& edge : shared) neighbours.insert(std::minmax(edge.one, edge.other));
    const std::vector<Edge> edges = edgesOf(mesh);
    const test::ScreenBuckets buckets = test::piecesByPlace(mesh);
    test::Random random(3);
    int met = 0;
    for (int i = 0; i < kLooks; ++i) {
        const Edge& edge = edges[static_cast<size_t>(random.uniform(0, static_cast<double>(edges.size())))];
        const glm::dvec2 along = glm::normalize(edge.to - edge.from), across(-along.y, along.x);
        const glm::dvec2 px = glm::mix(edge.from, edge.to, random.uniform(0.1, 0.9));
        for (const glm::dvec2 look : {px + kAcrossPx * across, px - kAcrossPx * across}) {
            for (const uint32_t k : buckets.at(look)) {
                if (k == edge.piece || test::depthInside(mesh, mesh.pieces[k], look) < kClearPx) continue;
                ++met;
                EXPECT_TRUE(neighbours.contains(std::minmax(k, edge.piece))) << look.x << ", " << look.y;
            }
        }
    }
    EXPECT_GT(met, kLooks / 4);
}

struct Shown {
    const char *wall, *display;
    double mostTornShare = 0;
};

// GoogleTest would print the bytes, addresses among them, into the names that ctest shows.
void PrintTo(const Shown& shown, std::ostream* out) { *out << shown.wall << ", " << shown.display; }

std::string nameOf(const ::testing::TestParamInfo<Shown>& test) {
    std::string name = std::string(test.param.wall) + "_" + test.param.display;
    std::ranges::replace(name, '-', '_');
    return name;
}

class SmoothDisplays : public ::testing::TestWithParam<Shown> {};

// A million points in all.
TEST_P(SmoothDisplays, NeighboursAgreeAlongTheirEdges) {
    constexpr int kPoints = 125'000;
    const JoinedPieces pieces = joinedPieces(GetParam().wall, GetParam().display);
    expectAllNeighboursFound(pieces.mesh, pieces.all);
    EXPECT_LE(pieces.tornShare, GetParam().mostTornShare);
    const Apart most = mostApart(pieces.mesh, pieces.joined, kPoints, 1);
    EXPECT_LE(most.exactPx, 1e-9);
    EXPECT_LE(most.roundedPx, kSnapPx);
    EXPECT_LE(most.floatPx, 1e-2);
}

// Cells at the rim of a circle hold on to their few pixels rather than to each other.
INSTANTIATE_TEST_SUITE_P(
    Shipped, SmoothDisplays,
    ::testing::Values(Shown{"full-cylinder", "front"}, Shown{"half-cylinder-off-axis", "wall"},
                      Shown{"dome-master", "dome", 0.01}, Shown{"camera", "fisheye"},
                      Shown{"curvilinear", "front"}, Shown{"camera-texture", "projector"},
                      Shown{"five-projector-dome", "ahead"}, Shown{"five-projector-dome", "zenith"}),
    nameOf);

class TornDisplays : public ::testing::TestWithParam<Shown> {};

// Where the scale has no bound facets are seen edge-on: rounding their edges, or calculating in single
// precision, may move them by any amount there.
TEST_P(TornDisplays, NeighboursAgreeWhereTheyAreJoined) {
    constexpr int kPoints = 50'000;
    const JoinedPieces pieces = joinedPieces(GetParam().wall, GetParam().display);
    EXPECT_LE(pieces.tornShare, GetParam().mostTornShare);
    EXPECT_LE(mostApart(pieces.mesh, pieces.joined, kPoints, 1).exactPx, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Shipped, TornDisplays,
                         ::testing::Values(Shown{"warp-mesh", "projector", 0.01},
                                           Shown{"radial", "orthographic", 0.2}),
                         nameOf);

}  // namespace
}  // namespace curvewall
