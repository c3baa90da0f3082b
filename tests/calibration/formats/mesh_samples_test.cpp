// Meshes of real installations. Their numbers, and projectors that four programs describe alike.

#include "calibration/formats/calibration_file.h"
#include "calibration/formats/mesh_file.h"
#include "tests/support/random_numbers.h"
#include "tests/support/sample_paths.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>
#include <string>
#include <vector>

namespace curvewall {
namespace {

namespace fs = std::filesystem;

class MeshSamples : public testing::Test {
protected:
    void SetUp() override {
        if (!fs::exists(test::samplesFolder())) GTEST_SKIP() << "no folder " << test::samplesFolder();
    }

    static FileBytes sample(const std::string& name) {
        return readFile((test::samplesFolder() / name).string(), "a sample");
    }
    static MeshCalibration mesh(const std::string& name) {
        Decisions decisions;
        const FileBytes file = sample(name);
        return readMesh(file, filesBeside(file.path), decisions);
    }
};

constexpr double kPrinted = 5e-5;  // the tables have four digits

std::string simcad(int channel, const std::string& ending) {
    return "sgct-history/config/dome/simcad/channel" + std::to_string(channel) + ending;
}

void expectNear(glm::dvec2 read, glm::dvec2 expected, double tolerance) {
    EXPECT_NEAR(read.x, expected.x, tolerance);
    EXPECT_NEAR(read.y, expected.y, tolerance);
}

// --- Numbers that were read by other means ---

struct SgcFacts {
    const char* file;
    size_t vertices;
    glm::dvec2 firstScreen, firstTexture, lastScreen, lastTexture;  // as the file has them
    std::array<double, 4> fovDeg;                                   // up, down, left, right
};

class SgcSamples : public MeshSamples, public testing::WithParamInterface<SgcFacts> {};

TEST_P(SgcSamples, HaveTheNumbersThatWereReadByOtherMeans) {
    const SgcFacts& facts = GetParam();
    const MeshCalibration read = mesh(std::string("sgct-history/config/dome/") + facts.file);
    ASSERT_EQ(read.vertices.size(), facts.vertices);
    const MeshVertex &first = read.vertices.front().value(), &last = read.vertices.back().value();
    const auto flipped = [](glm::dvec2 uv) { return glm::dvec2(uv.x, 1 - uv.y); };
    expectNear(first.screen, facts.firstScreen, kPrinted);
    expectNear(first.source, flipped(facts.firstTexture), kPrinted);
    expectNear(last.screen, facts.lastScreen, kPrinted);
    expectNear(last.source, flipped(facts.lastTexture), kPrinted);
    const Frustum& frustum = read.frustum.value();
    EXPECT_NEAR(glm::degrees(frustum.upRad), facts.fovDeg[0], 5e-4);
    EXPECT_NEAR(glm::degrees(frustum.downRad), facts.fovDeg[1], 5e-4);
    EXPECT_NEAR(glm::degrees(frustum.leftRad), facts.fovDeg[2], 5e-4);
    EXPECT_NEAR(glm::degrees(frustum.rightRad), facts.fovDeg[3], 5e-4);
}

INSTANTIATE_TEST_SUITE_P(Current, SgcSamples,
                         testing::Values(SgcFacts{"sciss/current/channel1_planar.sgc",
                                                  8281,
                                                  {0, 1},
                                                  {0, 0.0365},
                                                  {1, 0},
                                                  {0.9262, 0.9983},
                                                  {36.071, -32.108, -47.325, 47.520}},
                                         SgcFacts{"sciss/current/channel2_planar.sgc",
                                                  8281,
                                                  {0, 1},
                                                  {0, 0.0148},
                                                  {1, 0},
                                                  {0.9374, 0.9479},
                                                  {37.228, -31.498, -48.306, 47.477}},
                                         SgcFacts{"sciss/current/channel3_planar.sgc",
                                                  8281,
                                                  {0, 1},
                                                  {0, 0.0466},
                                                  {1, 0},
                                                  {0.9340, 0.9813},
                                                  {37.829, -31.982, -47.519, 47.330}},
                                         SgcFacts{"sciss/current/channel4_planar.sgc",
                                                  8281,
                                                  {0, 1},
                                                  {0, 0.0329},
                                                  {1, 0},
                                                  {0.9375, 0.9923},
                                                  {37.173, -31.762, -46.063, 46.947}},
                                         SgcFacts{"sciss/current/channel5_planar.sgc",
                                                  8281,
                                                  {0, 1},
                                                  {0, 0.0371},
                                                  {1, 0},
                                                  {0.9235, 1.0000},
                                                  {36.205, -31.493, -46.799, 48.050}},
                                         SgcFacts{"sciss/current/channel6_planar.sgc",
                                                  8281,
                                                  {0, 1},
                                                  {0, 0.1045},
                                                  {1, 0},
                                                  {0.8889, 1.0000},
                                                  {35.084, -34.285, -41.249, 37.559}}));

constexpr std::array<double, 4> kLowerDeg{70.238, 7.701, -58.865, 58.865};
constexpr std::array<double, 4> kUpperDeg{55.336, -11.608, -58.992, 58.992};

INSTANTIATE_TEST_SUITE_P(Converted, SgcSamples,
                         testing::Values(SgcFacts{"simcad/channel1_warp_u2.sgc",
                                                  1089,
                                                  {0.1940, 0.0310},
                                                  {0, 1},
                                                  {1.0447, 0.9967},
                                                  {1, 0},
                                                  kLowerDeg},
                                         SgcFacts{"simcad/channel2_warp_u2.sgc",
                                                  1089,
                                                  {0.1777, 0.0567},
                                                  {0, 1},
                                                  {1.0505, 1.0110},
                                                  {1, 0},
                                                  kLowerDeg},
                                         SgcFacts{"simcad/channel3_warp_u2.sgc",
                                                  1089,
                                                  {0.1830, 0.0363},
                                                  {0, 1},
                                                  {1.0448, 0.9808},
                                                  {1, 0},
                                                  kLowerDeg},
                                         SgcFacts{"simcad/channel4_warp_u2.sgc",
                                                  1089,
                                                  {0.1850, 0.0274},
                                                  {0, 1},
                                                  {1.0312, 0.9690},
                                                  {1, 0},
                                                  kLowerDeg},
                                         SgcFacts{"simcad/channel5_warp_u2.sgc",
                                                  1089,
                                                  {-0.0247, 0.2675},
                                                  {0, 1},
                                                  {0.9555, 0.9733},
                                                  {1, 0},
                                                  kUpperDeg},
                                         SgcFacts{"simcad/channel6_warp_u2.sgc",
                                                  1089,
                                                  {-0.0050, 0.2714},
                                                  {0, 1},
                                                  {0.9652, 0.9855},
                                                  {1, 0},
                                                  kUpperDeg}));

struct BourkeFacts {
    const char* file;
    glm::ivec2 nodes;
    glm::dvec2 firstTexture, lastTexture;
    double firstIntensity, lastIntensity, lowestIntensity;
};

class BourkeSamples : public MeshSamples, public testing::WithParamInterface<BourkeFacts> {};

TEST_P(BourkeSamples, HaveTheNumbersThatWereReadByOtherMeans) {
    const BourkeFacts& facts = GetParam();
    const MeshCalibration read = mesh(std::string("bourke/") + facts.file);
    const auto columns = static_cast<size_t>(facts.nodes.x), rows = static_cast<size_t>(facts.nodes.y);
    ASSERT_EQ(read.vertices.size(), columns * rows);
    EXPECT_EQ(read.cells.size(), 2 * (columns - 1) * (rows - 1));
    EXPECT_NEAR(read.aspect.value(), 1.7778, kPrinted);
    EXPECT_TRUE(std::ranges::all_of(read.vertices, [](const auto& v) { return v.has_value(); }));
    const MeshVertex &first = *read.vertices.front(), &last = *read.vertices.back();
    expectNear(first.screen, {0, 1}, 1e-12);  // the bottom row is the first one
    expectNear(last.screen, {1, 0}, 1e-12);
    expectNear(first.source, {facts.firstTexture.x, 1 - facts.firstTexture.y}, kPrinted);
    expectNear(last.source, {facts.lastTexture.x, 1 - facts.lastTexture.y}, kPrinted);
    EXPECT_NEAR(first.intensity, facts.firstIntensity, kPrinted);
    EXPECT_NEAR(last.intensity, facts.lastIntensity, kPrinted);
    double lowest = 1, highest = 0;
    for (const auto& vertex : read.vertices) {
        lowest = std::min(lowest, vertex->intensity);
        highest = std::max(highest, vertex->intensity);
    }
    EXPECT_NEAR(lowest, facts.lowestIntensity, kPrinted);
    EXPECT_EQ(highest, 1);
}

INSTANTIATE_TEST_SUITE_P(
    Mirrors, BourkeSamples,
    testing::Values(
        BourkeFacts{"ocvwarp_EP_xyuv_1920.map", {100, 60}, {0.1608, 0.8674}, {0, 0}, 0.5305, 0.0206, 0.0202},
        BourkeFacts{"sgct_standard_16x9.data", {100, 60}, {0.1608, 0.8674}, {0, 0}, 0.5305, 0.0206, 0.0202},
        BourkeFacts{"wwt_warp_mirror_16x9.data", {71, 40}, {0.3322, 0.9710}, {0.5, 0.9549}, 0.2319, 0, 0}));

TEST_F(MeshSamples, FrustumFilesHaveTheirTable) {
    const std::array<double, 6> headingsDeg{-45, 45, 135, -135, 57, -123};
    for (int channel = 1; channel <= 6; ++channel) {
        const Frustum frustum = mesh(simcad(channel, "_warp_mesh.csv")).frustum.value();
        const auto& fovDeg = channel <= 4 ? kLowerDeg : kUpperDeg;
        EXPECT_NEAR(glm::degrees(frustum.orientation.yawRad), headingsDeg[static_cast<size_t>(channel - 1)],
                    1e-5);
        EXPECT_NEAR(glm::degrees(frustum.orientation.pitchRad), channel <= 4 ? 0 : 48, 1e-5);
        EXPECT_NEAR(glm::degrees(frustum.orientation.rollRad), 0, 1e-5);
        EXPECT_NEAR(glm::degrees(frustum.upRad), fovDeg[0], 1e-5);
        EXPECT_NEAR(glm::degrees(frustum.downRad), fovDeg[1], 1e-5);
        EXPECT_NEAR(glm::degrees(frustum.leftRad), fovDeg[2], 1e-5);
        EXPECT_NEAR(glm::degrees(frustum.rightRad), fovDeg[3], 1e-5);
    }
}

TEST_F(MeshSamples, AllLoadAsTheyAre) {
    const std::set<std::string> kEndings{".sgc", ".simcad", ".csv", ".data", ".map", ".obj"};
    int loaded = 0;
    for (const auto& entry : fs::recursive_directory_iterator(test::samplesFolder())) {
        const FileBytes named{entry.path().string(), ""};
        if (!entry.is_regular_file() || !kEndings.contains(named.extension())) continue;
        const FileBytes file = readFile(named.path, "a sample");
        if (file.stem().ends_with("_frustum")) {
            EXPECT_FALSE(isMeshFile(file)) << file.path;
            continue;
        }
        SCOPED_TRACE(file.path);
        ++loaded;
        ASSERT_TRUE(isMeshFile(file));
        Decisions decisions;
        const Wall wall =
            readCalibration(file, filesBeside(file.path), {.sizePx = glm::ivec2(160, 90)}, decisions);
        int seen = 0;
        for (int y = 0; y < 90; ++y)
            for (int x = 0; x < 160; ++x)
                seen += wall.displays.front().projection->unproject({x + 0.5, y + 0.5}) ? 1 : 0;
        EXPECT_GT(seen, 160 * 90 / 20);  // the narrowest covers 6 per cent
    }
    EXPECT_GE(loaded, 41);
}

TEST_F(MeshSamples, ObjMeshesShareTheirVerticesBetweenFaces) {
    for (const char* name : {"left", "right", "bottom", "top"}) {
        const MeshCalibration read = mesh(std::string("obj/") + name + "_warp2.obj");
        EXPECT_LE(read.vertices.size(), 2500U);
        EXPECT_GT(read.vertices.size(), 2400U);
        EXPECT_GT(read.cells.size(), 4780U);
    }
}

// --- The same projector in four formats ---

const std::array<std::string, 4> kSameMesh{"_warp.simcad", "_warp_mesh.csv", "_warp_u2.sgc", "_warp_u3.sgc"};

TEST_F(MeshSamples, TheSameMeshHasTheSameVertices) {
    for (int channel = 1; channel <= 6; ++channel) {
        std::vector<MeshCalibration> read;
        for (const std::string& ending : kSameMesh) read.push_back(mesh(simcad(channel, ending)));
        const auto farthest = [&](size_t a, size_t b) {
            double worst = 0;
            for (size_t i = 0; i < 1089; ++i) {
                const glm::dvec2 screen = glm::abs(read[a].vertices[i]->screen - read[b].vertices[i]->screen);
                const glm::dvec2 source = glm::abs(read[a].vertices[i]->source - read[b].vertices[i]->source);
                worst = std::max({worst, screen.x, screen.y, source.x, source.y});
            }
            return worst;
        };
        for (const MeshCalibration& one : read) ASSERT_EQ(one.vertices.size(), 1089U);
        EXPECT_LT(farthest(0, 1), 5.6e-7) << "channel " << channel;
        EXPECT_LT(farthest(1, 2), 5.6e-7) << "channel " << channel;
        EXPECT_EQ(farthest(2, 3), 0) << "channel " << channel;
    }
}

Display displayOf(const FileBytes& file, glm::ivec2 sizePx) {
    Decisions decisions;
    return readCalibration(file, filesBeside(file.path), {.sizePx = sizePx}, decisions).displays.front();
}

struct Comparison {
    double worstPx = 0;  // how far from a pixel `b` shows what `a` shows there
    int compared = 0;
    int onlyInA = 0;  // pixels that are holes in `b`
};

void compareAt(glm::dvec2 px, const Projection& a, const Projection& b, Comparison& result) {
    const auto ray = a.unproject(px);
    if (!ray) return;
    ++result.compared;
    double nearest = std::numeric_limits<double>::infinity();
    for (const glm::dvec2 back : b.project(*ray)) nearest = std::min(nearest, glm::distance(back, px));
    if (nearest == std::numeric_limits<double>::infinity())
        ++result.onlyInA;
    else
        result.worstPx = std::max(result.worstPx, nearest);
}

class SameProjector : public MeshSamples, public testing::WithParamInterface<int> {};

TEST_P(SameProjector, IsTheSameProjectionInFourFormats) {
    const glm::ivec2 size(320, 200);
    std::vector<ProjectionPtr> projections;
    for (const std::string& ending : kSameMesh)
        projections.push_back(displayOf(sample(simcad(GetParam(), ending)), size).projection);
    for (const ProjectionPtr& a : projections)
        for (const ProjectionPtr& b : projections) {
            if (a == b) continue;
            Comparison result;
            for (int y = 0; y < size.y; ++y)
                for (int x = 0; x < size.x; ++x) compareAt({x + 0.5, y + 0.5}, *a, *b, result);
            test::Random random(6);
            for (int i = 0; i < 20'000; ++i) compareAt(random.pixel(size), *a, *b, result);
            EXPECT_GT(result.compared, 60'000);
            EXPECT_LT(result.worstPx, 1e-5 * size.x);
            EXPECT_EQ(result.onlyInA, 0);
        }
}

INSTANTIATE_TEST_SUITE_P(AllSix, SameProjector, testing::Range(1, 7));

// --- Where the projectors look ---

glm::dvec3 forwardOf(const MeshCalibration& mesh) {
    return rotationFromOrientation(mesh.frustum.value().orientation) * glm::dvec3(0, 0, -1);
}

// Headings of simcad/dome_sushi_test_sgc.xml, beside the files; its pitches differ from theirs by 1.5
// degrees.
TEST_F(MeshSamples, QuaternionsLookWhereTheConfigurationBesideThemSays) {
    const std::array<Orientation, 6> configured{{{glm::radians(-45.0), 0, 0},
                                                 {glm::radians(45.0), 0, 0},
                                                 {glm::radians(135.0), 0, 0},
                                                 {glm::radians(-135.0), 0, 0},
                                                 {glm::radians(57.0), glm::radians(49.5), 0},
                                                 {glm::radians(-123.0), glm::radians(49.5), 0}}};
    for (int channel = 1; channel <= 6; ++channel) {
        const Orientation& orientation = configured[static_cast<size_t>(channel - 1)];
        const glm::dvec3 expected = rotationFromOrientation(orientation) * glm::dvec3(0, 0, -1);
        EXPECT_GT(glm::dot(forwardOf(mesh(simcad(channel, "_warp_u2.sgc"))), expected),
                  std::cos(glm::radians(1.6)));
    }
}

// The corners of sciss/current/dome_gamma_6win.xml are the dome's design, tilted by its 27 degrees: the
// measured pictures, which stand upright, lie within 5 degrees of them. Any other reading of the quaternion
// is off by 30 degrees and more.
TEST_F(MeshSamples, MeasuredPicturesLieNearTheDesignOfTheirDome) {
    struct Plane {
        glm::dvec3 lowerLeft, upperLeft, upperRight;
    };
    const std::array<Plane, 6> design{
        {{{-5.187650, -1.880789, -5.637431},
          {-5.187650, 4.301180, -4.666044},
          {5.187650, 4.301180, -4.666044}},
         {{3.99047, -2.27161, -6.41449}, {0.52340, 2.77854, -7.69348}, {3.72955, 7.21219, 1.12186}},
         {{7.65389, 1.52968, 1.14354}, {5.51113, 4.74851, -3.77663}, {-2.88266, 7.48866, 1.67155}},
         {{0.73990, 4.26983, 6.59172}, {2.88266, 7.48866, 1.67155}, {-5.51113, 4.74851, -3.77663}},
         {{-7.19661, 2.16204, 2.40085}, {-3.72955, 7.21219, 1.12186}, {-0.52340, 2.77854, -7.69348}},
         {{-4.04754, 3.98483, -6.11950}, {-3.67653, 7.45540, 0.78096}, {4.04754, 7.28869, 0.44951}}}};
    const glm::dmat3 untilted = rotationFromOrientation({0, glm::radians(27.0), 0});
    for (int channel = 1; channel <= 6; ++channel) {
        const Plane& plane = design[static_cast<size_t>(channel - 1)];
        const glm::dvec3 right = glm::normalize(plane.upperRight - plane.upperLeft);
        const glm::dvec3 up = glm::normalize(plane.upperLeft - plane.lowerLeft);
        const glm::dmat3 designed(right, up, glm::cross(right, up));
        const glm::dmat3 measured = rotationFromOrientation(
            mesh("sgct-history/config/dome/sciss/current/channel" + std::to_string(channel) + "_planar.sgc")
                .frustum.value()
                .orientation);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_GT(glm::dot(untilted * designed[axis], measured[axis]), std::cos(glm::radians(7.0)))
                << "channel " << channel << ", axis " << axis;
    }
}

}  // namespace
}  // namespace curvewall
