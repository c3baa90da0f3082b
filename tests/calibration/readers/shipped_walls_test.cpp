// The walls of several displays in configs/: whether neighbours show the same things at the same places.

#include "tests/support/shipped_walls.h"

#include "tests/support/blend_sum.h"
#include "tests/support/random_numbers.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <set>
#include <string>
#include <vector>

namespace curvewall {
namespace {

// Along an edge of a picture, t from 0 to 1; down and to the right.
glm::dvec2 leftEdge(const Display& display, double t) { return {0, t * display.sizePx.y}; }
glm::dvec2 rightEdge(const Display& display, double t) { return {display.sizePx.x, t * display.sizePx.y}; }
glm::dvec2 topEdge(const Display& display, double t) { return {t * display.sizePx.x, 0}; }
glm::dvec2 bottomEdge(const Display& display, double t) { return {t * display.sizePx.x, display.sizePx.y}; }

// The position of `display` that shows what `from` shows at `px`.
glm::dvec2 carried(const Display& from, glm::dvec2 px, const Display& display) {
    const auto positions = display.projection->project(*from.projection->unproject(px));
    EXPECT_EQ(positions.size(), 1u) << from.name << " to " << display.name;
    return positions.empty() ? glm::dvec2(NAN) : positions.front();
}

// Both displays put the same point of the wall where they show the same ray, and the way back leads home.
void expectAgreement(const Display& one, glm::dvec2 px, const Display& other) {
    const glm::dvec2 there = carried(one, px, other);
    const glm::dvec3 point = *one.projection->unproject(px);
    EXPECT_LT(glm::distance(*other.projection->unproject(there), point), 1e-12)
        << one.name << ", " << other.name;
    EXPECT_LT(glm::distance(carried(other, there, one), px), 1e-8) << one.name << ", " << other.name;
}

struct CurvedWall {
    const char* name;
    size_t displays;
    double arcDeg, stepDeg, totalDeg;  // of one display, from one to the next, of all
};

// GoogleTest would print the bytes, addresses among them, into the names that ctest shows.
void PrintTo(const CurvedWall& wall, std::ostream* out) { *out << wall.name; }

class CurvedWalls : public ::testing::TestWithParam<CurvedWall> {};
INSTANTIATE_TEST_SUITE_P(Shipped, CurvedWalls,
                         ::testing::Values(CurvedWall{"curved-three-screen", 3, 64, 58, 180},
                                           CurvedWall{"cylinder-220", 4, 61, 53, 220}),
                         [](const auto& test) { return std::to_string(int(test.param.totalDeg)); });

TEST_P(CurvedWalls, NeighboursShowTheSameWhereTheyOverlap) {
    const Wall wall = test::shippedWall(GetParam().name);
    ASSERT_EQ(wall.displays.size(), GetParam().displays);
    test::Random random(1);
    for (size_t i = 0; i + 1 < wall.displays.size(); ++i) {
        const Display &left = wall.displays[i], &right = wall.displays[i + 1];
        const double stepPx = left.sizePx.x * GetParam().stepDeg / GetParam().arcDeg;
        for (int k = 0; k < 1000; ++k) {
            const glm::dvec2 px(random.uniform(stepPx, left.sizePx.x), random.uniform(0, left.sizePx.y));
            expectAgreement(left, px, right);
            EXPECT_LT(glm::distance(carried(left, px, right), px - glm::dvec2(stepPx, 0)), 1e-8);
        }
    }
}

// Read off the rays: whether the wall is as long as it says, and runs from the left to the right.
TEST_P(CurvedWalls, GoAroundAsFarAsTheySay) {
    const Wall wall = test::shippedWall(GetParam().name);
    const auto azimuthDeg = [&](const Display& display, glm::dvec2 px) {
        const glm::dvec3 point = wall.eyeM + *display.projection->unproject(px);
        return std::atan2(point.x, -point.z) * 180 / std::acos(-1);
    };
    EXPECT_NEAR(azimuthDeg(wall.displays.front(), {0, 100}), -0.5 * GetParam().totalDeg, 1e-9);
    EXPECT_NEAR(azimuthDeg(wall.displays.back(), wall.displays.back().sizePx), 0.5 * GetParam().totalDeg,
                1e-9);
}

struct SharedEdge {
    const char *one, *other;
    glm::dvec2 (*edgeOfOne)(const Display&, double);
    glm::dvec2 (*edgeOfOther)(const Display&, double);
    bool reversed;  // one runs against the other
};

TEST(Cave, EveryEdgeIsSharedExactly) {
    const std::vector<SharedEdge> edges{{"left", "front", rightEdge, leftEdge, false},
                                        {"front", "right", rightEdge, leftEdge, false},
                                        {"front", "floor", bottomEdge, topEdge, false},
                                        {"left", "floor", bottomEdge, leftEdge, true},
                                        {"right", "floor", bottomEdge, rightEdge, false}};
    const Wall wall = test::shippedWall("cave");
    for (const SharedEdge& edge : edges) {
        const Display &one = findDisplay(wall, edge.one), &other = findDisplay(wall, edge.other);
        test::Random random(1);
        for (int i = 0; i < 1000; ++i) {
            const double t = random.uniform(0, 1);
            const glm::dvec2 px = edge.edgeOfOne(one, t),
                             there = edge.edgeOfOther(other, edge.reversed ? 1 - t : t);
            EXPECT_LT(glm::distance(carried(one, px, other), there), 1e-9) << edge.one << ", " << edge.other;
            expectAgreement(one, px, other);
        }
    }
}

struct UprightWall {
    const char* name;
    double
        horizonRow;  // of the displays that stand upright: (how much the top is above the eye) / (pixel size)
};

void PrintTo(const UprightWall& wall, std::ostream* out) { *out << wall.name; }

class WallsOfSeveralScreens : public ::testing::TestWithParam<UprightWall> {};
INSTANTIATE_TEST_SUITE_P(Shipped, WallsOfSeveralScreens,
                         ::testing::Values(UprightWall{"curved-three-screen", 540},
                                           UprightWall{"cylinder-220", 600 + 0.2 * 1200 / 2.3289237206},
                                           UprightWall{"cave", (2.25 - 1.7) * 1200 / 2.25}),
                         [](const auto& test) {
                             std::string name = test.param.name;
                             std::erase(name, '-');
                             return name;
                         });

TEST_P(WallsOfSeveralScreens, HaveSquarePixelsOfOneSizeAndNothingIsMirrored) {
    const Wall wall = test::shippedWall(GetParam().name);
    const auto point = [](const Display& display, glm::dvec2 px) {
        return *display.projection->unproject(px);
    };
    const auto stepM = [&](const Display& display, glm::dvec2 px, glm::dvec2 step) {
        return (point(display, px + step) - point(display, px - step)) / 2.0;
    };
    const double sizeM = glm::length(stepM(wall.displays.front(), {100, 100}, {1, 0}));
    test::Random random(1);
    for (const Display& display : wall.displays)
        for (int i = 0; i < 100; ++i) {
            const glm::dvec2 px = random.pixel(display.sizePx);
            const glm::dvec3 right = stepM(display, px, {1, 0}), down = stepM(display, px, {0, 1});
            EXPECT_NEAR(glm::length(right), sizeM, 1e-6 * sizeM) << display.name;
            EXPECT_NEAR(glm::length(down), sizeM, 1e-6 * sizeM) << display.name;
            EXPECT_NEAR(glm::dot(right, down), 0, 1e-6 * sizeM * sizeM) << display.name;
            EXPECT_GT(glm::determinant(glm::dmat3(right, down, point(display, px))), 0) << display.name;
        }
}

TEST_P(WallsOfSeveralScreens, KeepTheHorizonOnOneRow) {
    const Wall wall = test::shippedWall(GetParam().name);
    test::Random random(1);
    std::set<std::string> shown;
    for (const Display& display : wall.displays)
        for (int i = 0; i < 1000; ++i) {
            const double azimuth = random.uniform(-3, 3);
            for (const glm::dvec2 px :
                 display.projection->project({std::sin(azimuth), 0, -std::cos(azimuth)})) {
                EXPECT_NEAR(px.y, GetParam().horizonRow, 1e-6) << display.name;
                if (test::distanceToBorderPx(display.sizePx, px) >= 0) shown.insert(display.name);
            }
        }
    EXPECT_GE(shown.size(), 3u);
}

}  // namespace
}  // namespace curvewall
