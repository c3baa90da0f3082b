#include "calibration/projections/warp_mesh.h"

#include "calibration/errors.h"
#include "calibration/projections/planar.h"
#include "calibration/readers/grid_reader.h"
#include "calibration/readers/wall_reader.h"
#include "tests/support/random_numbers.h"
#include "tests/support/temporary_folder.h"

#include <glm/glm.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace curvewall {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr glm::ivec2 kSizePx(640, 480), kSourcePx(400, 400);

double nearest(const std::vector<glm::dvec2>& positions, glm::dvec2 px) {
    double best = std::numeric_limits<double>::infinity();
    for (const glm::dvec2 p : positions) best = std::min(best, glm::distance(p, px));
    return best;
}

// Vertices of a grid, as [x, y, u, v, intensity], from p in the unit square.
using Vertex = std::function<json(glm::dvec2)>;

json gridMesh(glm::ivec2 nodes, const Vertex& vertex) {
    json mesh{{"grid", {nodes.x, nodes.y}}, {"vertices", json::array()}};
    for (int y = 0; y < nodes.y; ++y)
        for (int x = 0; x < nodes.x; ++x)
            mesh["vertices"].push_back(vertex(glm::dvec2(x, y) / glm::dvec2(nodes - 1)));
    return mesh;
}

json smoothVertex(glm::dvec2 p) {
    return {640 * p.x + 9 * std::sin(6 * p.y), 480 * p.y - 7 * std::cos(5 * p.x),
            0.1 + 0.8 * p.x + 0.05 * std::sin(4 * p.y), 0.9 - 0.7 * p.y * (0.6 + 0.4 * p.x)};
}

class WarpMeshFile : public ::testing::Test {
protected:
    ReadProjection read(const json& mesh, const json& changes = json::object()) const {
        folder_.write("mesh.json", mesh.dump());
        json keys{{"mesh", "mesh.json"},
                  {"screen_units", "px"},
                  {"source_origin", "top_left"},
                  {"source",
                   {{"size", {kSourcePx.x, kSourcePx.y}},
                    {"projection",
                     {{"type", "planar"},
                      {"lower_left", {-1, -1, -1}},
                      {"lower_right", {1, -1, -1}},
                      {"upper_left", {-1, 1, -1}}}}}}};
        keys.merge_patch(changes);
        JsonFields fields(keys, "projection");
        std::vector<std::string> files;
        ReadProjection read = readWarpMesh(fields, {{folder_.path(), files}, {}, kSizePx});
        fields.refuseUnknownKeys();
        return read;
    }
    std::string complaint(const json& mesh, const json& changes = json::object()) const {
        try {
            read(mesh, changes);
        } catch (const std::exception& error) {
            return error.what();
        }
        return "nothing";
    }
    test::TemporaryFolder folder_;
};

// The ray of the source's plane that shows (u, v), v down.
glm::dvec3 sourceRay(double u, double v) { return {2 * u - 1, 1 - 2 * v, -1}; }

TEST_F(WarpMeshFile, EveryPixelComesBack) {
    uint64_t seed = 1;
    for (const char* interpolation : {"triangles", "bilinear"})
        for (const glm::ivec2 nodes : {glm::ivec2(2), glm::ivec2(33), glm::ivec2(100, 60)}) {
            const ReadProjection mesh =
                read(gridMesh(nodes, smoothVertex), {{"interpolation", interpolation}});
            EXPECT_THAT(mesh.intensity, IsEmpty());
            test::Random random(seed++);
            int seen = 0;
            for (int i = 0; i < 100'000; ++i) {
                glm::dvec2 px = random.pixel(kSizePx);
                if (i % 3 == 0) {  // on a vertex, an edge, a diagonal
                    const glm::dvec2 p = glm::round(random.pixel(nodes - 1)) / glm::dvec2(nodes - 1);
                    const glm::dvec2 q =
                        glm::min(p + glm::dvec2(i % 2, i / 2 % 2) / glm::dvec2(nodes - 1), glm::dvec2(1));
                    const json a = smoothVertex(p), b = smoothVertex(q);
                    px = glm::mix(glm::dvec2(a[0], a[1]), glm::dvec2(b[0], b[1]), random.uniform(0, 1));
                }
                const auto ray = mesh.projection->unproject(px);
                if (!ray) continue;
                ++seen;
                const auto back = mesh.projection->project(*ray);
                ASSERT_EQ(back.size(), 1u) << px.x << ", " << px.y;
                ASSERT_LT(glm::distance(back[0], px), 1e-6);
            }
            EXPECT_GT(seen, 95'000);
        }
}

TEST_F(WarpMeshFile, TrianglesAreAffineAndCutFromTheFirstVertexToTheLast) {
    const json mesh{{"grid", {2, 2}},
                    {"vertices", {{0, 0, 0, 0}, {640, 0, 1, 0}, {0, 480, 0, 1}, {640, 480, 0.5, 0.5}}}};
    const ProjectionPtr projection = read(mesh).projection;
    const auto expect = [&](glm::dvec2 px, double u, double v) {
        EXPECT_LT(glm::distance(*projection->unproject(px), sourceRay(u, v)), 1e-12) << px.x << ", " << px.y;
    };
    expect({320, 240}, 0.25, 0.25);    // the diagonal
    expect({480, 120}, 0.625, 0.125);  // (0, 0) (1, 0) (1, 1): a quarter, a half, a quarter
    expect({160, 360}, 0.125, 0.625);
    const ProjectionPtr bilinear = read(mesh, {{"interpolation", "bilinear"}}).projection;
    EXPECT_LT(glm::distance(*bilinear->unproject({320, 240}), sourceRay(0.375, 0.375)), 1e-12);
}

TEST_F(WarpMeshFile, TrianglesMayBeListed) {
    const json mesh{{"triangles", {{0, 1, 2}}}, {"vertices", {{0, 0, 0, 0}, {640, 0, 1, 0}, {0, 480, 0, 1}}}};
    const ProjectionPtr projection = read(mesh).projection;
    EXPECT_LT(glm::distance(*projection->unproject({160, 120}), sourceRay(0.25, 0.25)), 1e-12);
    EXPECT_FALSE(projection->unproject({480, 360}));
}

TEST_F(WarpMeshFile, UnitsOfTheScreenAndOriginOfTheSourceMeanWhatTheySay) {
    const json px{{"grid", {2, 2}},
                  {"vertices", {{0, 0, 0, 0}, {640, 0, 1, 0}, {0, 480, 0, 0.5}, {640, 480, 1, 0.5}}}};
    const json normalized{{"grid", {2, 2}},
                          {"vertices", {{0, 0, 0, 0}, {1, 0, 1, 0}, {0, 1, 0, 0.5}, {1, 1, 1, 0.5}}}};
    const double a = 640.0 / 480;
    // Bottom row first and v up, as such programs write it.
    const json aspect{{"grid", {2, 2}},
                      {"vertices", {{-a, -1, 0, 0.5}, {a, -1, 1, 0.5}, {-a, 1, 0, 1}, {a, 1, 1, 1}}}};
    for (const auto& projection :
         {read(px).projection, read(normalized, {{"screen_units", "normalized"}}).projection,
          read(aspect, {{"screen_units", "aspect"}, {"source_origin", "bottom_left"}}).projection})
        EXPECT_LT(glm::distance(*projection->unproject({160, 120}), sourceRay(0.25, 0.125)), 1e-12);
}

TEST_F(WarpMeshFile, CellsWithAVertexThatIsNotDrawnAreHoles) {
    const json bad = json::parse(
        "[null, [320, 240, -0.1, 0.5], [320, 240, 0.5, 1.001], [320, 240, 0.5, 0.5, -1], [1e30, 240, 0.5, "
        "0.5]]");
    for (const json& vertex : bad) {
        json mesh = gridMesh({5, 5}, [](glm::dvec2 p) { return json{640 * p.x, 480 * p.y, p.x, p.y}; });
        mesh["vertices"][12] = vertex;
        for (const char* interpolation : {"triangles", "bilinear"}) {
            const ProjectionPtr projection = read(mesh, {{"interpolation", interpolation}}).projection;
            EXPECT_FALSE(projection->unproject({319, 239}));
            EXPECT_FALSE(projection->unproject({321, 241}));
            EXPECT_THAT(projection->project(sourceRay(0.49, 0.49)), IsEmpty());
            EXPECT_TRUE(projection->unproject({159, 239}));
            EXPECT_TRUE(projection->unproject({481, 241}));
            // Only the triangle next to it is missing there.
            EXPECT_EQ(projection->unproject({161, 121}).has_value(), interpolation == std::string("none"));
            EXPECT_EQ(projection->unproject({310, 359}).has_value(),
                      interpolation == std::string("triangles"));
        }
    }
}

TEST_F(WarpMeshFile, FoldsShowTheSideThatMostCellsShowAndHaveAllAnswers) {
    const double x[] = {0, 400, 200, 640};  // columns of the screen; the second is turned back
    const ProjectionPtr projection = read(gridMesh({4, 2}, [&](glm::dvec2 p) {
                                         return json{x[std::lround(3 * p.x)], 480 * p.y, p.x, p.y};
                                     })).projection;
    EXPECT_LT(glm::distance(*projection->unproject({300, 240}), sourceRay(0.25, 0.5)), 1e-12);
    EXPECT_THAT(projection->project(sourceRay(0.25, 0.5)), SizeIs(1));
    // The picture folded onto the screen twice is seen in two places.
    const ProjectionPtr twice = read(gridMesh({3, 2}, [](glm::dvec2 p) {
                                    return json{640 * p.x, 480 * p.y, 1 - std::abs(2 * p.x - 1), p.y};
                                })).projection;
    const auto seen = twice->project(sourceRay(0.5, 0.5));
    ASSERT_THAT(seen, SizeIs(2));
    EXPECT_LT(nearest(seen, {160, 240}), 1e-9);
    EXPECT_LT(nearest(seen, {480, 240}), 1e-9);
}

TEST_F(WarpMeshFile, IntensityMultipliesInLinearLight) {
    const auto vertex = [](glm::dvec2 p) { return json{640 * p.x, 480 * p.y, p.x, p.y, p.x}; };
    const auto at = [](const std::vector<float>& factors, int x, int y) {
        return factors[static_cast<size_t>(y) * kSizePx.x + static_cast<size_t>(x)];
    };
    const ReadProjection encoded = read(gridMesh({2, 2}, vertex));
    ASSERT_THAT(encoded.intensity, SizeIs(640 * 480));
    EXPECT_NEAR(at(encoded.intensity, 160, 100), std::pow(160.5 / 640, 2.2), 1e-6);
    const ReadProjection linear = read(gridMesh({2, 2}, vertex), {{"intensity_gamma", 1}});
    EXPECT_NEAR(at(linear.intensity, 160, 100), 160.5 / 640, 1e-6);
}

TEST_F(WarpMeshFile, AWallDimsItsPictureByTheMesh) {
    folder_.write("mesh.json", gridMesh({2, 2}, [](glm::dvec2 p) {
                                   return json{p.x, p.y, p.x, p.y, 0.5};
                               }).dump());
    const json planar{{"type", "planar"},
                      {"lower_left", {-1, -1, -1}},
                      {"lower_right", {1, -1, -1}},
                      {"upper_left", {-1, 1, -1}}};
    const json display{{"name", "a"},
                       {"size", {8, 4}},
                       {"projection",
                        {{"type", "warp_mesh"},
                         {"mesh", "mesh.json"},
                         {"screen_units", "normalized"},
                         {"source_origin", "top_left"},
                         {"intensity_gamma", 1},
                         {"source", {{"size", {10, 10}}, {"projection", planar}}}}}};
    const Wall wall =
        readWall(folder_.write("wall.json", json{{"wall", "w"}, {"displays", {display}}}.dump()));
    ASSERT_TRUE(wall.displays[0].blend);
    EXPECT_EQ(wall.displays[0].blend->alpha, std::vector<glm::vec3>(32, glm::vec3(0.5f)));
}

TEST_F(WarpMeshFile, AnotherEyeLooksAtTheSource) {
    const ProjectionPtr projection = read(gridMesh({9, 9}, smoothVertex)).projection;
    const glm::dvec3 eye(0.2, 0.1, 0.3);
    EXPECT_LT(glm::distance(*projection->seenFrom(eye)->unproject({300, 200}) + eye,
                            *projection->unproject({300, 200})),
              1e-12);
    EXPECT_THROW((void)projection->seenFrom({0, 0, -1}), UsageError);
}

TEST_F(WarpMeshFile, ErrorsNameTheFileTheFieldAndWhatWasExpected) {
    const json good = gridMesh({2, 2}, smoothVertex);
    const auto changed = [&](const char* pointer, const json& value) {
        json mesh = good;
        mesh[json::json_pointer(pointer)] = value;
        return mesh;
    };
    EXPECT_THAT(complaint(changed("/grid", {3, 2})),
                HasSubstr("mesh.json: vertices: expected 6 for a grid of 3 x 2, found 4"));
    EXPECT_THAT(complaint(changed("/grid", {4, 1})),
                HasSubstr("mesh.json: grid[1]: expected a whole number from 2"));
    EXPECT_THAT(complaint(changed("/vertices/1", {1, 2, 3})),
                HasSubstr("vertices[1]: expected null or [x, y, u, v]"));
    EXPECT_THAT(complaint(changed("/vertices/1", {1, 2, 3, "x"})),
                HasSubstr("vertices[1]: expected numbers, found \"x\""));
    EXPECT_THAT(complaint(changed("/vertices", json::array())), HasSubstr("vertices: expected a list"));
    EXPECT_THAT(complaint(changed("/colour", 1)), HasSubstr("\"colour\""));
    EXPECT_THAT(complaint(changed("/triangles", {{0, 1, 2}})), HasSubstr("a grid or triangles, found both"));
    EXPECT_THAT(complaint(changed("/vertices/1", {1, 2, 3, 4, 1e300})),
                HasSubstr("vertices[1]: expected an intensity of 1000 at most, found 1e+300"));
    EXPECT_THAT(complaint({{"vertices", good["vertices"]}}), HasSubstr("a grid or triangles"));
    const auto triangles = [&](const json& list) {
        return json{{"vertices", good["vertices"]}, {"triangles", list}};
    };
    EXPECT_THAT(complaint(triangles({{0, 1, 4}})),
                HasSubstr("triangles[0]: expected vertex numbers from 0 to 3, found 4"));
    EXPECT_THAT(complaint(triangles({{0, 1, -1}})), HasSubstr("found -1"));
    EXPECT_THAT(complaint(triangles({{0, 1}})), HasSubstr("a list of 3"));
    EXPECT_THAT(complaint(triangles({{0, 1, 1}})), HasSubstr("a mesh that covers an area"));
    EXPECT_THAT(complaint(triangles({{0, 1, 2}}), {{"interpolation", "bilinear"}}),
                HasSubstr("projection.interpolation"));
    EXPECT_THAT(complaint(gridMesh({2, 2}, [](glm::dvec2) { return json(nullptr); })),
                HasSubstr("mesh.json: expected a mesh"));
    EXPECT_THAT(complaint(good, {{"screen_units", nullptr}}), HasSubstr("projection.screen_units"));
    EXPECT_THAT(complaint(good, {{"source_origin", "middle"}}), HasSubstr("top_left (v grows downwards) or"));
    EXPECT_THAT(complaint(good, {{"source", {{"size", nullptr}}}}), HasSubstr("projection.source.size"));
    EXPECT_THAT(complaint(good, {{"source", {{"projection", {{"type", "warp_mesh"}}}}}}),
                HasSubstr("any type but another warp_mesh"));
    EXPECT_THAT(complaint(good, {{"source", {{"projection", {{"type", "cone"}}}}}}),
                HasSubstr("projection.source.projection.type"));
    EXPECT_THAT(complaint(good, {{"source", {{"projection", {{"radius", 1}}}}}}), HasSubstr("\"radius\""));
    EXPECT_THAT(complaint(good, {{"intensity_gamma", 0}}), HasSubstr("projection.intensity_gamma"));
    EXPECT_THAT(complaint(good, {{"mesh", "absent.json"}}), HasSubstr("absent.json"));
    folder_.write("broken.json", "{\"grid\": [2,");
    EXPECT_THAT(complaint(good, {{"mesh", "broken.json"}}), HasSubstr("broken.json: expected JSON"));
}

}  // namespace
}  // namespace curvewall
