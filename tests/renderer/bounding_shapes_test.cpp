// The shapes around pictures of triangles against the pictures: exact rays through pixels, and places of
// points of the triangles, in double precision.

#include "renderer/bounding_shapes.h"

#include "tests/renderer/bounding_shapes_single.h"
#include "tests/renderer/seen_triangles.h"
#include "tests/support/random_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace curvewall {
namespace {

using glm::dvec2, glm::dvec3;
using test::BoundingShape, test::Lens, test::ShapeKind, test::Triangle;

constexpr double kPi = test::kPi;

BoundingShape boundsInDouble(ShapeKind kind, const Lens& lens, double margin, const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    const double* terms = lens.coefficients.data();
    if (isQuad(kind)) {
        const auto quads = kind == ShapeKind::quad ? maths::quadBounds : maths::genericBounds;
        const auto quad = quads(lens.model, terms, lens.edge, margin, a, b, c);
        return {kind, {quad.corners, quad.corners + 4 * quad.count}};
    }
    const auto bounds = kind == ShapeKind::ring ? maths::ringBounds : maths::triangleBounds;
    const maths::BoundingTriangles t = bounds(lens.model, terms, lens.edge, margin, a, b, c);
    return {kind, {t.corners, t.corners + 3 * t.count}, t.before, t.cut};
}

BoundingShape boundsInSingle(ShapeKind kind, const Lens& lens, double margin, const Triangle& triangle) {
    test::SingleLens single{lens.model, {}, static_cast<float>(lens.edge)};
    std::ranges::transform(lens.coefficients, single.coefficients.begin(),
                           [](double c) { return static_cast<float>(c); });
    return test::boundsInSingle(kind, single, static_cast<float>(margin),
                                {triangle[0], triangle[1], triangle[2]});
}

// The shapes of all kinds in both precisions.
std::vector<BoundingShape> allBounds(const Lens& lens, double margin, const Triangle& triangle) {
    std::vector<BoundingShape> shapes;
    for (const ShapeKind kind :
         {ShapeKind::triangle, ShapeKind::quad, ShapeKind::genericQuad, ShapeKind::ring}) {
        shapes.push_back(boundsInDouble(kind, lens, margin, triangle));
        shapes.push_back(boundsInSingle(kind, lens, margin, triangle));
    }
    return shapes;
}

// By how much the shapes miss what is seen, at worst.
struct Coverage {
    size_t places = 0;
    double worst = -1e9;
    std::string where;

    void check(const std::vector<BoundingShape>& shapes, const Lens& lens, const Triangle& triangle,
               const std::vector<dvec3>& directions) {
        for (const dvec3 direction : directions) {
            if (test::angleOf(direction) > lens.edge) continue;
            for (size_t i = 0; i < shapes.size(); ++i) {
                if ((shapes[i].kind == ShapeKind::ring) != (direction.z > 0)) continue;
                ++places;
                const double miss = test::missOf(shapes[i], direction, lens.place(direction));
                if (miss <= worst) continue;
                worst = miss;
                where = "shape " + std::to_string(i) + ": " + test::text(triangle, lens);
            }
        }
    }
};

bool canBeWide(int model) { return model != maths::kOrthographic; }

constexpr int kManyTriangles = 100'000;

class BoundingShapes : public testing::TestWithParam<int> {};

Coverage coverageOf(int model, bool wide, int count, uint64_t seed) {
    test::Random random(seed);
    Coverage coverage;
    for (int i = 0; i < count; ++i) {
        const Lens lens = test::anyLens(random, model, wide);
        const Triangle triangle = test::anyTriangle(random);
        coverage.check(allBounds(lens, 0, triangle), lens, triangle, test::seenOf(random, lens, triangle));
    }
    return coverage;
}

TEST_P(BoundingShapes, NothingSeenAheadIsMissed) {
    const Coverage coverage = coverageOf(GetParam(), false, kManyTriangles, 1);
    EXPECT_GT(coverage.places, 5'000'000u);
    EXPECT_LE(coverage.worst, 0) << coverage.where;
}

TEST_P(BoundingShapes, NothingSeenAllAroundIsMissed) {
    const Coverage coverage = coverageOf(GetParam(), canBeWide(GetParam()), kManyTriangles, 2);
    EXPECT_GT(coverage.places, 5'000'000u);
    EXPECT_LE(coverage.worst, 0) << coverage.where;
}

TEST_P(BoundingShapes, MarginIsKeptAllAround) {
    test::Random random(4);
    for (int i = 0; i < 2'000; ++i) {
        const Lens lens = test::anyLens(random, GetParam(), canBeWide(GetParam()));
        const Triangle triangle = test::anyTriangle(random);
        const double margin = test::power(random, -4, -1);
        for (BoundingShape shape : allBounds(lens, margin, triangle)) {
            if (shape.kind == ShapeKind::ring) continue;
            for (const dvec3 direction : test::seenOf(random, lens, triangle)) {
                if (direction.z > 0 || test::angleOf(direction) > lens.edge) continue;
                const double turn = random.uniform(0, 2 * kPi);
                const dvec2 place = lens.place(direction) + margin * dvec2(std::cos(turn), std::sin(turn));
                ASSERT_LE(test::missOf(shape, direction, place), 0) << test::text(triangle, lens);
            }
        }
    }
}

TEST_P(BoundingShapes, NoDirectionIsCoveredTwice) {
    test::Random random(5);
    size_t inside = 0;
    for (int i = 0; i < 5'000; ++i) {
        const Lens lens = test::anyLens(random, GetParam(), canBeWide(GetParam()));
        const Triangle triangle = test::anyTriangle(random);
        const std::vector<BoundingShape> shapes = allBounds(lens, 1e-3, triangle);
        for (int k = 0; k < 100; ++k) {
            const dvec3 direction = random.direction();
            if (test::angleOf(direction) > lens.edge) continue;
            for (const BoundingShape& shape : shapes) {
                const int times = test::timesCovered(shape, direction, lens.place(direction), 1e-6);
                ASSERT_LE(times, 1) << test::text(triangle, lens);
                inside += static_cast<size_t>(times);
            }
        }
    }
    EXPECT_GT(inside, 10'000u);
}

// The area of what is seen of a triangle ahead, from many places along its edges.
double seenArea(const Lens& lens, const Triangle& triangle) {
    constexpr int kSteps = 100;
    std::vector<dvec2> places;
    for (size_t i = 0; i < 3; ++i)
        for (int k = 0; k < kSteps; ++k)
            places.push_back(
                lens.place(glm::mix(triangle[i], triangle[(i + 1) % 3], static_cast<double>(k) / kSteps)));
    double area = 0;
    for (size_t i = 0; i < places.size(); ++i) {
        const dvec2 from = places[i], to = places[(i + 1) % places.size()];
        area += (from.x * to.y - from.y * to.x) / 2;
    }
    return std::abs(area);
}

TEST_P(BoundingShapes, SmallTrianglesAreBoundedTightly) {
    constexpr int kCount = 20'000;
    test::Random random(3);
    double seen = 0, triangles = 0, inSingle = 0, quads = 0, genericQuads = 0, count = 0;
    for (int i = 0; i < kCount; ++i) {
        const Lens lens = GetParam() == maths::kPolynomial ? test::anyPolynomial(random, kPi / 2)
                                                           : Lens{GetParam(), {}, kPi / 2};
        const Triangle triangle = test::anySmall(random);
        const BoundingShape shape = boundsInDouble(ShapeKind::triangle, lens, 0, triangle);
        seen += seenArea(lens, triangle);
        triangles += test::areaOf(shape);
        inSingle += test::areaOf(boundsInSingle(ShapeKind::triangle, lens, 0, triangle));
        quads += test::areaOf(boundsInDouble(ShapeKind::quad, lens, 0, triangle));
        genericQuads += test::areaOf(boundsInDouble(ShapeKind::genericQuad, lens, 0, triangle));
        count += static_cast<double>(shape.corners.size()) / 3;
    }
    RecordProperty("triangle_overdraw_percent", std::to_string(100 * (triangles / seen - 1)));
    RecordProperty("quad_overdraw_percent", std::to_string(100 * (quads / seen - 1)));
    RecordProperty("generic_quad_overdraw_percent", std::to_string(100 * (genericQuads / seen - 1)));
    RecordProperty("triangles_each", std::to_string(count / kCount));
    EXPECT_GT(triangles, seen);
    EXPECT_LT(triangles, 1.15 * seen);
    EXPECT_LT(inSingle, 1.15 * seen);
    EXPECT_LT(quads, 2.20 * seen);
    EXPECT_LT(quads, genericQuads);
}

INSTANTIATE_TEST_SUITE_P(Lenses, BoundingShapes, testing::ValuesIn(test::kModels),
                         [](const auto& lens) { return test::kModelNames[static_cast<size_t>(lens.param)]; });

// ---- Figure 4 of the paper, for the lenses whose curves are convex and for a polynomial close to one of
// them

class PaperFigure4 : public testing::TestWithParam<int> {
protected:
    Lens lens_{GetParam(), {1, 0, -0.04}, kPi / 2};

    dvec3 at(double azimuthDeg, double angleDeg) const {
        const double azimuth = azimuthDeg * kPi / 180, angle = angleDeg * kPi / 180;
        return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), -std::cos(angle)};
    }

    // How many triangles bound this one, if they miss nothing.
    size_t trianglesAround(const Triangle& triangle) const {
        test::Random random(6);
        Coverage coverage;
        for (int i = 0; i < 20; ++i)
            coverage.check(allBounds(lens_, 0, triangle), lens_, triangle,
                           test::seenOf(random, lens_, triangle));
        EXPECT_GT(coverage.places, 1'000u);
        EXPECT_LE(coverage.worst, 0) << coverage.where;
        return boundsInDouble(ShapeKind::triangle, lens_, 0, triangle).corners.size() / 3;
    }
};

TEST_P(PaperFigure4, TwoTrianglesWhereOneCornerIsBehindTheHorizon) {
    EXPECT_EQ(trianglesAround({at(-30, 50), at(30, 50), at(0, 130)}), 2u);
    EXPECT_EQ(trianglesAround({at(100, 20), at(-100, 30), 1e5 * at(10, 110)}), 2u);
}

TEST_P(PaperFigure4, OneTriangleWhereTwoCornersAreBehindTheHorizon) {
    EXPECT_EQ(trianglesAround({at(0, 40), at(-40, 120), at(40, 120)}), 1u);
    EXPECT_EQ(trianglesAround({1e-3 * at(80, 40), at(60, 95), 20.0 * at(95, 100)}), 1u);
}

// The middle corner is a little beyond the chord of the other two, on the axis' side of the arc between them.
TEST_P(PaperFigure4, TwoTrianglesWhereAnAngleIsLargerThanPi) {
    const dvec3 left = at(-40, 80), right = at(40, 80);
    const dvec2 chord = (lens_.place(left) + lens_.place(right)) / 2.0;
    const dvec2 arc = lens_.place(glm::normalize(left + right));
    const Triangle crescent{left, lens_.direction(glm::mix(chord, arc, 0.1)), right};
    EXPECT_EQ(trianglesAround(crescent), 2u);
}

TEST_P(PaperFigure4, FourTrianglesWhereACrescentIsCutByTheHorizonToo) {
    EXPECT_LE(trianglesAround({at(-75, 80), at(0, 78), at(75, 93)}), 4u);
    EXPECT_GE(trianglesAround({at(-75, 80), at(0, 78), at(75, 93)}), 3u);
}

INSTANTIATE_TEST_SUITE_P(Lenses, PaperFigure4, testing::ValuesIn(test::kModels),
                         [](const auto& lens) { return test::kModelNames[static_cast<size_t>(lens.param)]; });

// ---- What is not seen

TEST(BoundingShapesOfNothing, WhatIsBehindOrBeyondTheEdgeHasNoShape) {
    const Triangle behind{dvec3(1, 0, 0.1), dvec3(0, 1, 0.1), dvec3(-1, -1, 0.2)};
    const Triangle aside{dvec3(2, 0, -1), dvec3(3, 0.2, -1), dvec3(2.5, 1, -1)};
    for (const int model : test::kModels) {
        const Lens half{model, {1}, kPi / 2}, narrow{model, {1}, kPi / 4};
        for (const BoundingShape& shape : allBounds(half, 0.01, behind)) EXPECT_TRUE(shape.corners.empty());
        for (const BoundingShape& shape : allBounds(narrow, 0.01, aside)) EXPECT_TRUE(shape.corners.empty());
    }
}

TEST(BoundingShapesOfNothing, TriangleWithACornerInTheEyeHasNoShape) {
    const Triangle triangle{dvec3(0), dvec3(1, 0, -1), dvec3(0, 1, -1)};
    for (const BoundingShape& shape : allBounds({maths::kEquidistant, {}, kPi}, 0.01, triangle))
        EXPECT_TRUE(shape.corners.empty());
}

}  // namespace
}  // namespace curvewall
