#include "calibration/projections/surface_map.h"

#include "calibration/errors.h"
#include "calibration/readers/grid_reader.h"
#include "tests/support/map_writer.h"
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

constexpr glm::ivec2 kSizePx(640, 480);
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// The point of a screen at a position in fractions of the display, y down.
using Shape = std::function<glm::dvec3(glm::dvec2)>;

glm::dvec3 onPlane(glm::dvec2 p) {
    return glm::dvec3(-2, 1.5, -2) + p.x * glm::dvec3(4, 0.5, -1) - p.y * glm::dvec3(0.2, 3, 0);
}
glm::dvec3 onCylinder(glm::dvec2 p) {
    const double angle = 2.4 * (p.x - 0.5);
    return {3 * std::sin(angle), 1.2 - 2.4 * p.y, -3 * std::cos(angle)};
}
glm::dvec3 onSphere(glm::dvec2 p) {
    const double azimuth = 2.0 * (p.x - 0.5), elevation = 1.2 * (0.5 - p.y);
    return 2.5 * glm::dvec3(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                            -std::cos(elevation) * std::cos(azimuth));
}
// Hides parts of itself from an eye to the left.
glm::dvec3 onWaves(glm::dvec2 p) {
    return {4 * p.x - 2, 1.5 - 3 * p.y, -3 + 0.8 * std::sin(12 * p.x) + 0.1 * std::cos(9 * p.y)};
}

glm::dvec2 nodeAt(glm::ivec2 node, glm::ivec2 nodes, Alignment alignment) {
    return alignment == Alignment::corners ? glm::dvec2(node) / glm::dvec2(nodes - 1)
                                           : (glm::dvec2(node) + 0.5) / glm::dvec2(nodes);
}

NumberMap measured(const Shape& shape, glm::ivec2 nodes, Alignment alignment) {
    NumberMap map{nodes, 3, false, {}};
    for (int y = 0; y < nodes.y; ++y)
        for (int x = 0; x < nodes.x; ++x) {
            const glm::dvec3 point = shape(nodeAt({x, y}, nodes, alignment));
            map.values.insert(map.values.end(), {static_cast<float>(point.x), static_cast<float>(point.y),
                                                 static_cast<float>(point.z)});
        }
    return map;
}

SurfaceMap surfaceOf(NumberMap points, Alignment alignment, glm::dvec3 eyeM, double unitM = 1,
                     const Pose& pose = {}) {
    return {std::make_shared<const MeasuredSurface>(std::move(points), false, kSizePx, alignment), unitM,
            pose, eyeM};
}

double nearest(const std::vector<glm::dvec2>& positions, glm::dvec2 px) {
    double best = std::numeric_limits<double>::infinity();
    for (const glm::dvec2 p : positions) best = std::min(best, glm::distance(p, px));
    return best;
}

glm::dvec2 awkwardPixel(test::Random& random, glm::ivec2 nodes, Alignment alignment) {
    glm::dvec2 px = random.pixel(kSizePx);
    const glm::ivec2 node(static_cast<int>(random.uniform(0, nodes.x)),
                          static_cast<int>(random.uniform(0, nodes.y)));
    const glm::dvec2 line = nodeAt(node, nodes, alignment) * glm::dvec2(kSizePx);
    if (random.uniform(0, 1) < 0.3)
        px.x = line.x + (random.uniform(0, 1) < 0.5 ? 0 : random.uniform(-1e-9, 1e-9));
    if (random.uniform(0, 1) < 0.3) px.y = line.y;
    return glm::clamp(px, glm::dvec2(0), glm::dvec2(kSizePx));
}

// How many answers there were beyond one each.
int roundTrip(const Projection& projection, glm::ivec2 nodes, Alignment alignment, uint64_t seed,
              double leastSeen = 1) {
    test::Random random(seed);
    int seen = 0, more = 0;
    for (int i = 0; i < 100'000; ++i) {
        const glm::dvec2 px = awkwardPixel(random, nodes, alignment);
        const auto ray = projection.unproject(px);
        if (!ray) continue;
        ++seen;
        const auto back = projection.project(*ray * random.uniform(0.1, 10));
        more += static_cast<int>(back.size()) - 1;
        if (!(nearest(back, px) < 1e-6)) {
            ADD_FAILURE() << "off by " << nearest(back, px) << " at " << px.x << ", " << px.y;
            return more;
        }
    }
    EXPECT_GE(seen, 100'000 * leastSeen);
    return more;
}

TEST(SurfaceMap, EveryPixelComesBackFromAnyEye) {
    uint64_t seed = 1;
    for (const Shape& shape : {Shape(onPlane), Shape(onCylinder), Shape(onSphere)})
        for (const Alignment alignment : {Alignment::centers, Alignment::corners})
            for (const glm::ivec2 nodes : {glm::ivec2(2), glm::ivec2(33), glm::ivec2(257, 129)}) {
                const SurfaceMap surface =
                    surfaceOf(measured(shape, nodes, alignment), alignment, {0.4, -0.2, 0.3});
                EXPECT_EQ(roundTrip(surface, nodes, alignment, seed++), 0);
            }
}

TEST(SurfaceMap, ScreensThatHideThemselvesAndHaveHolesComeBackToo) {
    const glm::ivec2 nodes(129, 65);
    for (const Alignment alignment : {Alignment::centers, Alignment::corners}) {
        NumberMap points = measured(onWaves, nodes, alignment);
        const Pose pose{{3, 1, -2}, {0.5, 0.2, -0.1}};
        constexpr double kInchM = 0.0254;
        const glm::dvec3 eye =
            pose.centerM + rotationFromOrientation(pose.orientation) * (kInchM * glm::dvec3(-2.5, 0.2, -1.5));
        EXPECT_GT(roundTrip(surfaceOf(points, alignment, eye, kInchM, pose), nodes, alignment, 50), 100);
        for (int i = 0; i < nodes.x * nodes.y; i += 37)
            points.values[static_cast<size_t>(3 * i + i % 3)] = kNan;
        roundTrip(surfaceOf(points, alignment, {-1, 0.5, 1}), nodes, alignment, 51, 0.8);
    }
}

TEST(SurfaceMap, PlanesAreExactBeyondTheOutermostNodesToo) {
    // Numbers that float holds, so that nothing is lost in the file.
    const auto shape = [](glm::dvec2 p) { return glm::dvec3(8 * p.x - 4, 3 - 6 * p.y, -4 + 2 * p.x); };
    for (const Alignment alignment : {Alignment::centers, Alignment::corners}) {
        const glm::ivec2 nodes = alignment == Alignment::centers ? glm::ivec2(16, 8) : glm::ivec2(17, 9);
        const glm::dvec3 eye(0.5, 0.25, 1);
        const SurfaceMap surface = surfaceOf(measured(shape, nodes, alignment), alignment, eye);
        test::Random random(3);
        for (int i = 0; i < 10'000; ++i) {
            const glm::dvec2 px = random.pixel(kSizePx);
            const glm::dvec3 ray = shape(px / glm::dvec2(kSizePx)) - eye;
            ASSERT_LT(glm::distance(*surface.unproject(px), ray), 1e-13);
            const auto back = surface.project(ray);
            ASSERT_EQ(back.size(), 1u);
            ASSERT_LT(glm::distance(back[0], px), 1e-9);
        }
        EXPECT_FALSE(surface.unproject({-0.01, 10}));
        EXPECT_FALSE(surface.unproject({10, 480.01}));
    }
}

TEST(SurfaceMap, SpheresAndCylindersAgreeWithTheirClosedFormsToTheSagOfACell) {
    const glm::ivec2 nodes(160, 120);
    const glm::dvec3 eye(0.6, 0.3, 0.2);
    test::Random random(4);
    const SurfaceMap sphere =
        surfaceOf(measured(onSphere, nodes, Alignment::centers), Alignment::centers, eye);
    const SurfaceMap cylinder =
        surfaceOf(measured(onCylinder, nodes, Alignment::centers), Alignment::centers, eye);
    for (int i = 0; i < 10'000; ++i) {
        // A cell of 4 px spans 1/80 rad at most: sag 2.5 m / 8 / 6400 = 5e-5 m, of 5 mm a pixel.
        const glm::dvec2 p(random.uniform(0.02, 0.98), random.uniform(0.02, 0.98));
        for (const auto& [surface, shape] :
             {std::pair<const SurfaceMap*, Shape>{&sphere, onSphere}, {&cylinder, onCylinder}}) {
            const auto back = surface->project(shape(p) - eye);
            ASSERT_EQ(back.size(), 1u);
            ASSERT_LT(glm::distance(back[0], p * glm::dvec2(kSizePx)), 0.03);
        }
        // The ray meets the sphere |eye + t d| = 2.5 at t = -b + sqrt(b^2 - c), whatever the grid.
        const glm::dvec3 ray = *sphere.unproject(p * glm::dvec2(kSizePx)), d = glm::normalize(ray);
        const double b = glm::dot(eye, d), c = glm::dot(eye, eye) - 6.25;
        ASSERT_NEAR(glm::length(ray), -b + std::sqrt(b * b - c), 1.2e-4);
    }
}

TEST(SurfaceMap, RaysOfTheBackAreNotAnswers) {
    const SurfaceMap surface =
        surfaceOf(measured(onCylinder, {33, 33}, Alignment::corners), Alignment::corners, {});
    test::Random random(5);
    for (int i = 0; i < 1'000; ++i)
        EXPECT_THAT(surface.project(-*surface.unproject(random.pixel(kSizePx))), IsEmpty());
    for (const glm::dvec3 ray :
         {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(0), glm::dvec3(0, 0, 1)})
        EXPECT_THAT(surface.project(ray), IsEmpty());
}

// Ray against cells cut into small triangles, without any index.
TEST(SurfaceMap, AnswersAreThoseOfAllCellsTriedOneByOne) {
    const glm::ivec2 nodes(41, 13);
    const NumberMap points = measured(onWaves, nodes, Alignment::corners);
    const glm::dvec3 eye(-2.5, 0.2, -1.5);
    const SurfaceMap surface = surfaceOf(points, Alignment::corners, eye);
    const auto node = [&](int x, int y) {
        const float* number = points.at(x, y);
        return glm::dvec3(number[0], number[1], number[2]) - eye;
    };
    test::Random random(6);
    int answers = 0;
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 ray = *surface.unproject(random.pixel(kSizePx));
        std::vector<glm::dvec2> expected;
        for (int y = 0; y + 1 < nodes.y; ++y)
            for (int x = 0; x + 1 < nodes.x; ++x)
                for (int sub = 0; sub < 8 * 8 * 2; ++sub) {
                    constexpr double kStep = 1.0 / 8;
                    const glm::dvec2 corner(sub / 2 % 8 * kStep, sub / 16 * kStep);
                    const auto at = [&](glm::dvec2 st) {
                        return glm::mix(glm::mix(node(x, y), node(x + 1, y), st.x),
                                        glm::mix(node(x, y + 1), node(x + 1, y + 1), st.x), st.y);
                    };
                    const glm::dvec2 other = sub % 2 ? glm::dvec2(kStep, 0) : glm::dvec2(0, kStep);
                    const glm::dmat3 triangle(at(corner), at(corner + other), at(corner + kStep));
                    const glm::dvec3 weights = glm::inverse(triangle) * ray;
                    if (glm::all(glm::greaterThan(weights, glm::dvec3(0))))
                        expected.push_back((glm::dvec2(x, y) + corner +
                                            (weights.y * other + weights.z * glm::dvec2(kStep)) /
                                                (weights.x + weights.y + weights.z)) /
                                           glm::dvec2(nodes - 1) * glm::dvec2(kSizePx));
                }
        const auto found = surface.project(ray);
        for (const glm::dvec2 p : expected) ASSERT_LT(nearest(found, p), 0.5);
        for (const glm::dvec2 p : found) ASSERT_LT(nearest(expected, p), 0.5);
        answers += static_cast<int>(found.size());
    }
    EXPECT_GT(answers, 600);  // it does hide itself
}

TEST(SurfaceMap, PlacesWithoutAPointAreHoles) {
    NumberMap points = measured(onPlane, {5, 5}, Alignment::corners);
    const auto spoil = [&](int x, int y, float a, float b, float c) {
        float* number = &points.values[static_cast<size_t>(3 * (5 * y + x))];
        number[0] = a, number[1] = b, number[2] = c;
    };
    for (const auto& [a, b, c] :
         std::vector<std::array<float, 3>>{{kNan, 0, -1},
                                           {1, 1, kNan},
                                           {1, std::numeric_limits<float>::infinity(), 1},
                                           {9e-6f, -9e-6f, 0},
                                           {1e30f, 0, 0}}) {
        spoil(2, 1, a, b, c);
        const SurfaceMap surface = surfaceOf(points, Alignment::corners, {0, 0, 1});
        EXPECT_FALSE(surface.unproject({161, 1}));
        EXPECT_FALSE(surface.unproject({479, 239}));
        EXPECT_TRUE(surface.unproject({159, 1}));
        EXPECT_TRUE(surface.unproject({479, 241}));
    }
    spoil(2, 1, 1e-4f, 0, 0);  // a point, if an odd one
    EXPECT_TRUE(surfaceOf(points, Alignment::corners, {0, 0, 1}).unproject({161, 1}));
}

TEST(SurfaceMap, AnEyeOnTheScreenSeesTheRestOfIt) {
    const Alignment alignment = Alignment::corners;
    const NumberMap points = measured(onSphere, {33, 33}, alignment);
    const float* number = points.at(16, 16);
    const glm::dvec3 eye(number[0], number[1], number[2]);
    const SurfaceMap surface = surfaceOf(points, alignment, eye);
    EXPECT_FALSE(surface.unproject({320, 240}));
    test::Random random(7);
    for (int i = 0; i < 10'000; ++i) {
        const glm::dvec2 px = random.pixel(kSizePx);
        if (glm::distance(px, glm::dvec2(320, 240)) < 40)
            continue;  // the cells at the eye are seen from the side
        ASSERT_LT(nearest(surface.project(*surface.unproject(px)), px), 1e-6);
    }
}

TEST(SurfaceMap, AnotherEyeSharesThePoints) {
    const SurfaceMap surface =
        surfaceOf(measured(onSphere, {33, 33}, Alignment::corners), Alignment::corners, {1, 0, 0});
    const ProjectionPtr moved = surface.seenFrom({0, 0.5, 0.25});
    const glm::dvec2 px(123.4, 345.6);
    EXPECT_LT(glm::distance(*moved->unproject(px) + glm::dvec3(0, 0.5, 0.25),
                            *surface.unproject(px) + glm::dvec3(1, 0, 0)),
              1e-14);
    EXPECT_LT(nearest(moved->project(*moved->unproject(px)), px), 1e-9);
}

class SurfaceMapFile : public ::testing::Test {
protected:
    ProjectionPtr read(const json& keys) const {
        JsonFields fields(keys, "projection");
        std::vector<std::string> files;
        ProjectionPtr projection =
            readSurfaceMap(fields, {{folder_.path(), files}, {0.1, 0.2, 0.3}, kSizePx});
        fields.refuseUnknownKeys();
        return projection;
    }
    std::string complaint(const json& keys) const {
        try {
            read(keys);
        } catch (const std::exception& error) {
            return error.what();
        }
        return "nothing";
    }
    const json keys_{
        {"points", "points.exr"}, {"units", "m"}, {"alignment", "corners"}, {"origin", "top_left"}};
    test::TemporaryFolder folder_;
};

TEST_F(SurfaceMapFile, UnitsOriginAndPoseMeanWhatTheySay) {
    NumberMap points = measured(onSphere, {9, 9}, Alignment::corners);
    test::writeMap(folder_.path("points.exr"), points);
    const glm::dvec3 eye(0.1, 0.2, 0.3);
    const glm::dvec2 px(80, 120);  // a node
    const glm::dvec3 point = *read(keys_)->unproject(px) + eye;
    EXPECT_LT(glm::distance(point, onSphere(px / glm::dvec2(kSizePx))), 1e-6);

    const std::vector<std::pair<const char*, double>> units{{"dm", 0.1},    {"cm", 0.01},   {"mm", 0.001},
                                                            {"in", 0.0254}, {"ft", 0.3048}, {"yd", 0.9144}};
    for (const auto& [unit, metres] : units) {
        json keys = keys_;
        keys["units"] = unit;
        EXPECT_LT(glm::distance(*read(keys)->unproject(px) + eye, metres * point), 1e-12) << unit;
    }
    json keys = keys_;
    keys["origin"] = "bottom_left";
    EXPECT_LT(glm::distance(*read(keys)->unproject({80, 360}) + eye, point), 1e-12);
    // Turned to the right by 90 degrees, what was ahead is on the right; then it is moved.
    keys = keys_;
    keys["yaw_deg"] = 90;
    keys["center"] = {1, 2, 3};
    EXPECT_LT(glm::distance(*read(keys)->unproject(px) + eye,
                            glm::dvec3(-point.z, point.y, point.x) + glm::dvec3(1, 2, 3)),
              1e-12);
}

TEST_F(SurfaceMapFile, WhatCannotBeUsedIsRefusedByName) {
    for (const char* key : {"points", "units", "alignment", "origin"}) {
        json keys = keys_;
        keys.erase(key);
        EXPECT_THAT(complaint(keys), HasSubstr("projection." + std::string(key)));
    }
    json keys = keys_;
    keys["units"] = "furlong";
    EXPECT_THAT(complaint(keys), HasSubstr("m (metres) or"));
    const auto filled = [&](glm::ivec2 size, int channels, float value) {
        test::writeMap(folder_.path("points.exr"),
                       {size, channels, false,
                        std::vector<float>(static_cast<size_t>(size.x * size.y * channels), value)});
        return complaint(keys_);
    };
    EXPECT_THAT(filled({4, 4}, 2, 1), HasSubstr("points.exr: expected at least 3 channels, found 2"));
    EXPECT_THAT(filled({4, 1}, 3, 1), HasSubstr("at least 2 x 2 nodes, found 4 x 1"));
    EXPECT_THAT(filled({4, 4}, 3, kNan), HasSubstr("no valid sample"));
    EXPECT_THAT(filled({4, 4}, 3, 0), HasSubstr("no valid sample"));
    EXPECT_THAT(filled({4, 4}, 3, 5), HasSubstr("collapses everywhere"));
}

}  // namespace
}  // namespace curvewall
