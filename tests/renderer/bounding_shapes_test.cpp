// The shapes around pictures of triangles against the pictures: exact rays through pixels, and places of
// points of the triangles, in double precision.

#include "renderer/bounding_shapes.h"

#include "tests/renderer/bounding_shapes_single.h"
#include "tests/support/random_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace curvewall {
namespace {

using glm::dvec2, glm::dvec3;
using Triangle = std::array<dvec3, 3>;

constexpr double kPi = std::numbers::pi;
constexpr std::array kModels{maths::kOrthographic, maths::kStereographic, maths::kEquisolid,
                             maths::kEquidistant, maths::kPolynomial};
constexpr std::array kModelNames{"orthographic", "stereographic", "equisolid", "equidistant", "polynomial"};

struct Lens {
    int model = 0;
    std::array<double, maths::kRadialTerms> coefficients{};
    double edge = kPi / 2;

    dvec2 place(dvec3 direction) const {
        return maths::radialPosition(model, coefficients.data(), direction);
    }
    dvec3 direction(dvec2 place) const {
        return maths::radialDirection(model, coefficients.data(), place, edge);
    }
    double rim() const { return maths::radialRadius(model, coefficients.data(), edge); }
};

double angleOf(dvec3 direction) { return std::atan2(std::hypot(direction.x, direction.y), -direction.z); }

// ---- Shapes, of either precision

using Shape = test::SingleShape;  // any number of corners in threes, or four of a quad
enum class Kind { triangle, quad, ring };

Shape shapeOf(const maths::BoundingTriangles& triangles) {
    Shape shape{{}, triangles.before, triangles.cut};
    shape.corners.assign(triangles.corners, triangles.corners + 3 * triangles.count);
    return shape;
}

Shape boundsInDouble(Kind kind, const Lens& lens, double margin, const Triangle& t) {
    const double* c = lens.coefficients.data();
    if (kind == Kind::triangle)
        return shapeOf(maths::triangleBounds(lens.model, c, lens.edge, margin, t[0], t[1], t[2]));
    if (kind == Kind::ring)
        return shapeOf(maths::ringBounds(lens.model, c, lens.edge, margin, t[0], t[1], t[2]));
    const auto quad = maths::quadBounds(lens.model, c, lens.edge, margin, t[0], t[1], t[2]);
    Shape shape;
    shape.corners.assign(quad.corners, quad.corners + 4 * quad.count);
    return shape;
}

Shape boundsInSingle(Kind kind, const Lens& lens, double margin, const Triangle& t) {
    test::SingleLens single{lens.model, {}, static_cast<float>(lens.edge)};
    std::ranges::transform(lens.coefficients, single.coefficients.begin(),
                           [](double c) { return static_cast<float>(c); });
    const test::SingleTriangle corners{glm::vec3(t[0]), glm::vec3(t[1]), glm::vec3(t[2])};
    const auto bounds = kind == Kind::triangle ? test::singleTriangleBounds
                        : kind == Kind::quad   ? test::singleQuadBounds
                                               : test::singleRingBounds;
    return bounds(single, static_cast<float>(margin), corners);
}

double turn(dvec2 a, dvec2 b, dvec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

// By how much the convex polygon around these corners leaves a place outside; none, at most 0, if inside.
double outsideOf(const dvec2* corners, size_t count, dvec2 place) {
    double area = 0;
    for (size_t i = 2; i < count; ++i) area += turn(corners[0], corners[i - 1], corners[i]);
    double worst = -std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < count; ++i) {
        const dvec2 from = corners[i], to = corners[(i + 1) % count];
        const double length = glm::length(to - from);
        if (length > 0) worst = std::max(worst, (area < 0 ? 1 : -1) * turn(from, to, place) / length);
    }
    return worst;
}

double areaOf(const Shape& shape, Kind kind) {
    const size_t step = kind == Kind::quad ? 4 : 3;
    double area = 0;
    for (size_t i = 0; i < shape.corners.size(); i += step)
        for (size_t k = 2; k < step; ++k)
            area += std::abs(turn(shape.corners[i], shape.corners[i + k - 1], shape.corners[i + k])) / 2;
    return area;
}

// By how much the shape misses the place of a direction, at most 0 if it does not.
double missOf(const Shape& shape, Kind kind, dvec3 direction, dvec2 place) {
    const size_t step = kind == Kind::quad ? 4 : 3, before = static_cast<size_t>(shape.before) * 3;
    const bool first = kind == Kind::quad || glm::dot(shape.cut, direction) >= 0;
    const size_t begin = first ? 0 : before;
    const size_t end = kind == Kind::quad || !first ? shape.corners.size() : before;
    double miss = std::numeric_limits<double>::infinity();
    for (size_t i = begin; i < end; i += step)
        miss = std::min(miss, outsideOf(&shape.corners[i], step, place));
    return miss;
}

// ---- Triangles

dvec3 rounded(dvec3 v) { return dvec3(glm::vec3(v)); }

double power(test::Random& random, double least, double most) {
    return std::pow(10.0, random.uniform(least, most));
}

dvec3 ahead(test::Random& random) {
    const dvec3 direction = random.direction();
    return {direction.x, direction.y, -std::abs(direction.z)};
}

// Around a direction, each corner at a distance of its own.
Triangle around(test::Random& random, dvec3 centre, double size, double scale) {
    Triangle triangle;
    for (dvec3& corner : triangle) corner = scale * random.uniform(0.5, 2) * (centre + random.inBox(size));
    return triangle;
}

Triangle anySliver(test::Random& random) {
    const dvec3 a = random.direction(),
                b = random.uniform(0, 1) < 0.5 ? random.direction() : a + random.inBox(0.3);
    const double width = power(random, -9, -2);
    return {a, b, glm::mix(a, b, random.uniform(0, 1)) + random.inBox(width)};
}

// A long thin triangle close to the horizon, curved more than it is wide.
Triangle anyCrescent(test::Random& random) {
    const auto at = [](double azimuth, double angle) {
        return dvec3(std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
                     -std::cos(angle));
    };
    const double start = random.uniform(0, 2 * kPi), span = random.uniform(0.1, 3),
                 angle = random.uniform(0.3, 1.7);
    const double middle = start + span * random.uniform(0.1, 0.9);
    const dvec3 a = at(start, angle + random.uniform(-0.02, 0.02)), b = at(start + span, angle);
    const dvec3 onArc = glm::normalize(a * std::sin(start + span - middle) + b * std::sin(middle - start));
    return {a, b, onArc + random.inBox(0.03)};
}

Triangle anyNearEye(test::Random& random) {
    const dvec3 normal = random.direction(), right = glm::normalize(glm::cross(normal, random.direction()));
    const dvec3 up = glm::cross(normal, right);
    const double height = power(random, -7, -0.5);
    const double tilt = random.uniform(0, 1) < 0.2 ? 0.0 : height;
    Triangle triangle;
    for (dvec3& corner : triangle)
        corner = tilt * normal +
                 power(random, -3, 1) * (random.uniform(-1, 1) * right + random.uniform(-1, 1) * up);
    return triangle;
}

Triangle anyTriangle(test::Random& random) {
    const double scale = power(random, -4, 7);
    Triangle triangle;
    switch (static_cast<int>(random.uniform(0, 10))) {
        case 0:
            triangle = around(random, ahead(random), power(random, -4, -1), 1);
            break;
        case 1:
            triangle = {random.direction(), random.direction(), random.direction()};
            break;
        case 2:
            triangle = anySliver(random);
            break;
        case 3: {  // across the horizon
            const double azimuth = random.uniform(0, 2 * kPi);
            const dvec3 horizon(std::cos(azimuth), std::sin(azimuth),
                                power(random, -9, -1) - power(random, -9, -1));
            triangle = around(random, horizon, power(random, -4, 0), 1);
            break;
        }
        case 4:
            triangle = anyNearEye(random);
            break;
        case 5:  // around the axis, or close to it
            triangle = around(random, {0, 0, random.uniform(0, 1) < 0.8 ? -1 : 1}, power(random, -4, 0.5), 1);
            break;
        case 6:  // far and near corners
            for (dvec3& corner : triangle) corner = random.direction() * power(random, -8, 3);
            break;
        case 7:  // seen edge on, or a line, or a point
            triangle = around(random, random.direction(), 1, 1);
            triangle[2] = random.uniform(-1, 2) * triangle[0] + random.uniform(-1, 2) * triangle[1];
            if (random.uniform(0, 1) < 0.2) triangle[1] = triangle[0];
            if (random.uniform(0, 1) < 0.2) triangle[2] = triangle[1];
            break;
        case 8:
            triangle = anyCrescent(random);
            break;
        default:  // straight lines in the picture, corners on the axis and on the horizon
            triangle = around(random, ahead(random), power(random, -2, 0.3), 1);
            if (random.uniform(0, 1) < 0.5) triangle[1] = triangle[0] * dvec3(2, 2, random.uniform(-1, 1));
            if (random.uniform(0, 1) < 0.3) triangle[2].z = 0;
            if (random.uniform(0, 1) < 0.3) triangle[0] = dvec3(0, 0, random.uniform(0, 1) < 0.7 ? -1 : 1);
    }
    for (dvec3& corner : triangle) corner = rounded(scale * corner);
    return triangle;
}

// Increasing to the edge, whatever it does beyond.
Lens anyPolynomial(test::Random& random, double edge) {
    Lens lens{maths::kPolynomial, {}, edge};
    std::array<double, 5> root{1, 0, 0, 0, 0};
    const double wild = random.uniform(0, 1) < 0.7 ? 0.15 : 0.6;
    for (size_t i = 1; i < root.size(); ++i) root[i] = random.uniform(-wild, wild);
    for (size_t i = 0; i < root.size(); ++i)  // the slope is a square
        for (size_t k = 0; k < root.size(); ++k) lens.coefficients[i + k] += root[i] * root[k];
    for (size_t i = 0; i < lens.coefficients.size(); ++i) lens.coefficients[i] /= static_cast<double>(i + 1);
    for (double& c : lens.coefficients) c = static_cast<float>(c);
    return lens;
}

Lens anyLens(test::Random& random, int model, bool wide) {
    const double most = model == maths::kStereographic ? 0.95 * kPi : kPi;
    double edge = random.uniform(0, 1) < 0.5 ? kPi / 2 : random.uniform(0.1, kPi / 2);
    if (wide) edge = random.uniform(0, 1) < 0.3 ? most : random.uniform(kPi / 2 + 0.01, most);
    if (model == maths::kPolynomial) return anyPolynomial(random, edge);
    return {model, {}, edge};
}

// ---- What is seen of them

// What a triangle covers is told by the directions of its corners alone; those of length one lose no digits.
Triangle directionsOf(const Triangle& t) {
    return {glm::normalize(t[0]), glm::normalize(t[1]), glm::normalize(t[2])};
}

// Below this, what double precision says of nearly opposite directions, or of planes through the eye, is
// noise.
constexpr double kDecided = 1e-6;

// The ray in this direction meets the triangle (Möller and Trumbore).
bool meets(const Triangle& t, dvec3 direction) {
    const dvec3 first = t[1] - t[0], second = t[2] - t[0], p = glm::cross(direction, second);
    const double volume = glm::dot(first, p);
    if (std::abs(volume) < kDecided * kDecided) return false;
    const double u = glm::dot(-t[0], p) / volume;
    const dvec3 q = glm::cross(-t[0], first);
    const double v = glm::dot(direction, q) / volume;
    return u >= 0 && v >= 0 && u + v <= 1 && glm::dot(second, q) / volume > 0;
}

// Directions close together along the arc from one to another, with the one on the horizon.
void addDirections(std::vector<dvec3>& directions, dvec3 from, dvec3 to, int count) {
    const double angle = std::atan2(glm::length(glm::cross(from, to)), glm::dot(from, to));
    if (angle > kPi - kDecided) return;
    directions.push_back(from);
    for (int i = 1; i < count && angle > kDecided; ++i) {
        const double t = static_cast<double>(i) / count;
        directions.push_back(glm::normalize(from * std::sin((1 - t) * angle) + to * std::sin(t * angle)));
    }
    if (from.z * to.z < 0) {
        const dvec3 crossing = from * std::abs(to.z) + to * std::abs(from.z);
        if (glm::length(crossing) > kDecided * (std::abs(from.z) + std::abs(to.z)))
            directions.push_back(glm::normalize(dvec3(crossing.x, crossing.y, 0)));
    }
}

std::vector<dvec3> directionsIn(test::Random& random, const Triangle& t) {
    std::vector<dvec3> directions;
    for (size_t i = 0; i < 3; ++i) addDirections(directions, t[i], t[(i + 1) % 3], 24);
    if (glm::length(t[1] + t[2]) < 1e-3) return directions;
    for (int i = 0; i < 6; ++i)
        addDirections(directions, t[0], glm::normalize(glm::mix(t[1], t[2], random.uniform(0, 1))), 8);
    return directions;
}

// Those whose rays through a grid around the places given, and a little more, meet the triangle.
void addPixels(std::vector<dvec3>& directions, test::Random& random, const Lens& lens,
               const Triangle& triangle) {
    constexpr int kPixels = 16;
    dvec2 least(1e9), most(-1e9);
    for (const dvec3 direction : directions) {
        if (angleOf(direction) > lens.edge) continue;
        least = glm::min(least, lens.place(direction));
        most = glm::max(most, lens.place(direction));
    }
    const dvec2 step = (most - least) / (kPixels - 4.0);
    const dvec2 start = least - step * (1.5 + random.uniform(0, 1));
    for (int y = 0; y < kPixels && step.x >= 0; ++y)
        for (int x = 0; x < kPixels; ++x) {
            const dvec2 place = start + step * dvec2(x, y);
            if (glm::length(place) > lens.rim()) continue;
            const dvec3 direction = lens.direction(place);
            if (meets(triangle, direction)) directions.push_back(direction);
        }
}

std::string text(const Triangle& t, const Lens& lens) {
    std::string out = kModelNames[static_cast<size_t>(lens.model)];
    char buffer[400];
    for (const double c : lens.coefficients)
        out += (std::snprintf(buffer, sizeof buffer, " %.9g", c), buffer);
    std::snprintf(buffer, sizeof buffer,
                  " edge %.9g: {%.9g, %.9g, %.9g}, {%.9g, %.9g, %.9g}, {%.9g, %.9g, %.9g}", lens.edge, t[0].x,
                  t[0].y, t[0].z, t[1].x, t[1].y, t[1].z, t[2].x, t[2].y, t[2].z);
    return out + buffer;
}

// Whether all that is seen of the triangle lies within all shapes of both precisions.
struct Coverage {
    size_t places = 0;
    double worst = -1e9;
    std::string where;

    void check(const Lens& lens, const Triangle& triangle, const std::vector<dvec3>& directions) {
        struct Bound {
            Kind kind;
            bool single;
            Shape shape;
        };
        std::vector<Bound> bounds;
        for (const Kind kind : {Kind::triangle, Kind::quad, Kind::ring}) {
            bounds.push_back({kind, false, boundsInDouble(kind, lens, 0, triangle)});
            bounds.push_back({kind, true, boundsInSingle(kind, lens, 0, triangle)});
        }
        for (const dvec3 direction : directions) {
            const double angle = angleOf(direction);
            if (angle > lens.edge) continue;
            const dvec2 place = lens.place(direction);
            for (const Bound& bound : bounds) {
                if ((bound.kind == Kind::ring) != (direction.z > 0)) continue;
                ++places;
                const double miss = missOf(bound.shape, bound.kind, direction, place);
                if (miss <= worst) continue;
                worst = miss;
                where = std::string(bound.kind == Kind::triangle ? "triangle"
                                    : bound.kind == Kind::quad   ? "quad"
                                                                 : "ring") +
                        (bound.single ? " in single, " : " in double, ") + text(triangle, lens);
            }
        }
    }
};

bool hasCornerInEye(const Triangle& t) {
    return std::ranges::any_of(t, [](dvec3 corner) { return corner == dvec3(0); });
}

class BoundingShapes : public testing::TestWithParam<int> {};

Coverage coverageOf(int model, bool wide, int count, uint64_t seed) {
    test::Random random(seed);
    Coverage coverage;
    for (int i = 0; i < count; ++i) {
        const Lens lens = anyLens(random, model, wide);
        const Triangle triangle = anyTriangle(random);
        if (hasCornerInEye(triangle)) continue;
        const Triangle corners = directionsOf(triangle);
        std::vector<dvec3> directions = directionsIn(random, corners);
        addPixels(directions, random, lens, corners);
        coverage.check(lens, triangle, directions);
    }
    return coverage;
}

TEST_P(BoundingShapes, NothingSeenAheadIsMissed) {
    const Coverage coverage = coverageOf(GetParam(), false, 20'000, 1);
    EXPECT_GT(coverage.places, 1'000'000u);
    EXPECT_LE(coverage.worst, 0) << coverage.where;
}

TEST_P(BoundingShapes, NothingSeenAllAroundIsMissed) {
    if (GetParam() == maths::kOrthographic) GTEST_SKIP() << "sees half a turn";
    const Coverage coverage = coverageOf(GetParam(), true, 20'000, 2);
    EXPECT_GT(coverage.places, 1'000'000u);
    EXPECT_LE(coverage.worst, 0) << coverage.where;
}

// The area of what is seen of a triangle ahead, from many places along its edges.
double seenArea(const Lens& lens, const Triangle& triangle) {
    constexpr int kSteps = 100;
    std::vector<dvec2> places;
    for (size_t i = 0; i < 3; ++i)
        for (int k = 0; k < kSteps; ++k)
            places.push_back(lens.place(glm::mix(triangle[i], triangle[(i + 1) % 3], double(k) / kSteps)));
    double area = 0;
    for (size_t i = 0; i < places.size(); ++i) {
        const dvec2 from = places[i], to = places[(i + 1) % places.size()];
        area += (from.x * to.y - from.y * to.x) / 2;
    }
    return std::abs(area);
}

// Directions within 2.5 degrees of one, all ahead.
Triangle anySmall(test::Random& random) {
    for (;;) {
        const dvec3 centre = ahead(random);
        Triangle triangle;
        for (dvec3& corner : triangle) {
            do {
                corner = random.direction();
                corner = glm::normalize(centre + random.inBox(0.0437));
            } while (glm::dot(corner, centre) < std::cos(2.5 * kPi / 180));
        }
        if (std::ranges::all_of(triangle, [](dvec3 corner) { return corner.z < 0; })) return triangle;
    }
}

struct Overdraw {
    double triangle = 0, quad = 0, triangleInSingle = 0;
    double triangles = 0;
};

Overdraw overdrawOf(const std::function<Lens(test::Random&)>& lensOf) {
    test::Random random(3);
    double seen = 0;
    Overdraw sum;
    constexpr int kCount = 20'000;
    for (int i = 0; i < kCount; ++i) {
        const Lens lens = lensOf(random);
        const Triangle triangle = anySmall(random);
        seen += seenArea(lens, triangle);
        const Shape shape = boundsInDouble(Kind::triangle, lens, 0, triangle);
        sum.triangle += areaOf(shape, Kind::triangle);
        sum.triangleInSingle += areaOf(boundsInSingle(Kind::triangle, lens, 0, triangle), Kind::triangle);
        sum.quad += areaOf(boundsInDouble(Kind::quad, lens, 0, triangle), Kind::quad);
        sum.triangles += static_cast<double>(shape.corners.size()) / 3;
    }
    return {sum.triangle / seen - 1, sum.quad / seen - 1, sum.triangleInSingle / seen - 1,
            sum.triangles / kCount};
}

TEST_P(BoundingShapes, SmallTrianglesAreBoundedTightly) {
    const auto lensOf = [](test::Random& random) {
        return GetParam() == maths::kPolynomial ? anyPolynomial(random, kPi / 2)
                                                : Lens{GetParam(), {}, kPi / 2};
    };
    const Overdraw overdraw = overdrawOf(lensOf);
    std::printf("%s: triangle %.1f %% (%.1f %% in single), quad %.1f %%, %.2f triangles each\n",
                kModelNames[static_cast<size_t>(GetParam())], 100 * overdraw.triangle,
                100 * overdraw.triangleInSingle, 100 * overdraw.quad, overdraw.triangles);
    EXPECT_LT(overdraw.triangle, 0.15);
    EXPECT_LT(overdraw.triangleInSingle, 0.15);
    EXPECT_LT(overdraw.quad, 1.20);
}

INSTANTIATE_TEST_SUITE_P(Lenses, BoundingShapes, testing::ValuesIn(kModels),
                         [](const auto& lens) { return kModelNames[static_cast<size_t>(lens.param)]; });

}  // namespace
}  // namespace curvewall
