#pragma once
// Triangles of all kinds, and what a round lens sees of them, without a formula for outlines.

#include "calibration/projections/projection_maths.h"
#include "tests/support/random_numbers.h"
#include "tests/support/test_walls.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace curvewall::test {

inline constexpr std::array kModels{maths::kOrthographic, maths::kStereographic, maths::kEquisolid,
                                    maths::kEquidistant, maths::kPolynomial};
inline constexpr std::array kModelNames{"orthographic", "stereographic", "equisolid", "equidistant",
                                        "polynomial"};

struct Lens {
    int model = 0;
    std::array<double, maths::kRadialTerms> coefficients{};
    double edge = kPi / 2;

    glm::dvec2 place(glm::dvec3 direction) const {
        return maths::radialPosition(model, coefficients.data(), direction);
    }
    glm::dvec3 direction(glm::dvec2 place) const {
        return maths::radialDirection(model, coefficients.data(), place, edge);
    }
    double rim() const { return maths::radialRadius(model, coefficients.data(), edge); }
};

inline double angleOf(glm::dvec3 direction) {
    return std::atan2(std::hypot(direction.x, direction.y), -direction.z);
}

// ---- Triangles

using Triangle = std::array<glm::dvec3, 3>;

inline glm::dvec3 rounded(glm::dvec3 v) { return glm::dvec3(glm::vec3(v)); }

inline double power(Random& random, double least, double most) {
    return std::pow(10.0, random.uniform(least, most));
}

inline glm::dvec3 ahead(Random& random) {
    const glm::dvec3 direction = random.direction();
    return {direction.x, direction.y, -std::abs(direction.z)};
}

// Around a direction, each corner at a distance of its own.
inline Triangle around(Random& random, glm::dvec3 centre, double size, double scale) {
    Triangle triangle;
    for (glm::dvec3& corner : triangle)
        corner = scale * random.uniform(0.5, 2) * (centre + random.inBox(size));
    return triangle;
}

inline Triangle anySliver(Random& random) {
    const glm::dvec3 a = random.direction(),
                     b = random.uniform(0, 1) < 0.5 ? random.direction() : a + random.inBox(0.3);
    const double width = power(random, -9, -2);
    return {a, b, glm::mix(a, b, random.uniform(0, 1)) + random.inBox(width)};
}

// A long thin triangle close to the horizon, curved more than it is wide.
inline Triangle anyCrescent(Random& random) {
    const auto at = [](double azimuth, double angle) {
        return glm::dvec3(std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
                          -std::cos(angle));
    };
    const double start = random.uniform(0, 2 * kPi), span = random.uniform(0.1, 3),
                 angle = random.uniform(0.3, 1.7);
    const double middle = start + span * random.uniform(0.1, 0.9);
    const glm::dvec3 a = at(start, angle + random.uniform(-0.02, 0.02)), b = at(start + span, angle);
    const glm::dvec3 onArc =
        glm::normalize(a * std::sin(start + span - middle) + b * std::sin(middle - start));
    return {a, b, onArc + random.inBox(0.03)};
}

inline Triangle anyNearEye(Random& random) {
    const glm::dvec3 normal = random.direction(),
                     right = glm::normalize(glm::cross(normal, random.direction()));
    const glm::dvec3 up = glm::cross(normal, right);
    const double height = power(random, -7, -0.5);
    const double tilt = random.uniform(0, 1) < 0.2 ? 0.0 : height;
    Triangle triangle;
    for (glm::dvec3& corner : triangle)
        corner = tilt * normal +
                 power(random, -3, 1) * (random.uniform(-1, 1) * right + random.uniform(-1, 1) * up);
    return triangle;
}

inline Triangle aroundTheAxis(Random& random) {
    const double start = random.uniform(0, 2 * kPi);
    Triangle triangle;
    for (size_t i = 0; i < triangle.size(); ++i) {
        const double azimuth = start + 2 * kPi / 3 * static_cast<double>(i);
        triangle[i] =
            random.uniform(0.5, 2) * glm::dvec3(std::cos(azimuth), std::sin(azimuth), random.uniform(-2, 2));
    }
    return triangle;
}

inline Triangle anyTriangle(Random& random) {
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
            const glm::dvec3 horizon(std::cos(azimuth), std::sin(azimuth),
                                     power(random, -9, -1) - power(random, -9, -1));
            triangle = around(random, horizon, power(random, -4, 0), 1);
            break;
        }
        case 4:
            triangle = anyNearEye(random);
            break;
        case 5:  // around the axis, or close to it, or with azimuths that cancel out
            if (random.uniform(0, 1) < 0.3) {
                triangle = aroundTheAxis(random);
                break;
            }
            triangle = around(random, {0, 0, random.uniform(0, 1) < 0.8 ? -1 : 1}, power(random, -4, 0.5), 1);
            break;
        case 6:  // far and near corners
            for (glm::dvec3& corner : triangle) corner = random.direction() * power(random, -8, 3);
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
            if (random.uniform(0, 1) < 0.5)
                triangle[1] = triangle[0] * glm::dvec3(2, 2, random.uniform(-1, 1));
            if (random.uniform(0, 1) < 0.3) triangle[2].z = 0;
            if (random.uniform(0, 1) < 0.3)
                triangle[0] = glm::dvec3(0, 0, random.uniform(0, 1) < 0.7 ? -1 : 1);
    }
    for (glm::dvec3& corner : triangle) corner = rounded(scale * corner);
    return triangle;
}

// Corners anywhere within 2.5 degrees of a direction, all ahead.
inline Triangle anySmall(Random& random) {
    const double most = std::tan(2.5 * kPi / 180);
    for (;;) {
        const glm::dvec3 centre = ahead(random);
        Triangle triangle;
        for (glm::dvec3& corner : triangle) {
            glm::dvec3 aside;
            do {
                const glm::dvec3 offset = random.inBox(most);
                aside = offset - glm::dot(offset, centre) * centre;
            } while (glm::length(aside) > most);
            corner = glm::normalize(centre + aside);
        }
        if (std::ranges::all_of(triangle, [](glm::dvec3 corner) { return corner.z < 0; })) return triangle;
    }
}

// Increasing to the edge, whatever it does beyond.
inline Lens anyPolynomial(Random& random, double edge) {
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

inline Lens anyLens(Random& random, int model, bool wide) {
    const double most = model == maths::kStereographic ? 0.95 * kPi : kPi;
    double edge = random.uniform(0, 1) < 0.5 ? kPi / 2 : random.uniform(0.1, kPi / 2);
    if (wide) edge = random.uniform(0, 1) < 0.3 ? most : random.uniform(kPi / 2 + 0.01, most);
    if (model == maths::kPolynomial) return anyPolynomial(random, edge);
    return {model, {}, edge};
}

// ---- What is seen of them

// What a triangle covers is told by the directions of its corners alone; those of length one lose no digits.
inline Triangle directionsOf(const Triangle& t) {
    return {glm::normalize(t[0]), glm::normalize(t[1]), glm::normalize(t[2])};
}

// Below this, what double precision says of nearly opposite directions, or of planes through the eye, is
// noise.
inline constexpr double kDecided = 1e-6;

// The ray in this direction meets the triangle (Möller and Trumbore).
inline bool meets(const Triangle& t, glm::dvec3 direction) {
    const glm::dvec3 first = t[1] - t[0], second = t[2] - t[0], p = glm::cross(direction, second);
    const double volume = glm::dot(first, p);
    if (std::abs(volume) < kDecided * kDecided) return false;
    const double u = glm::dot(-t[0], p) / volume;
    const glm::dvec3 q = glm::cross(-t[0], first);
    const double v = glm::dot(direction, q) / volume;
    return u >= 0 && v >= 0 && u + v <= 1 && glm::dot(second, q) / volume > 0;
}

// Directions close together along the arc from one to another, with the one on the horizon.
inline void addDirections(std::vector<glm::dvec3>& directions, glm::dvec3 from, glm::dvec3 to, int count) {
    const double angle = std::atan2(glm::length(glm::cross(from, to)), glm::dot(from, to));
    if (angle > kPi - kDecided) return;
    directions.push_back(from);
    for (int i = 1; i < count && angle > kDecided; ++i) {
        const double t = static_cast<double>(i) / count;
        directions.push_back(glm::normalize(from * std::sin((1 - t) * angle) + to * std::sin(t * angle)));
    }
    if (from.z * to.z < 0) {
        const glm::dvec3 crossing = from * std::abs(to.z) + to * std::abs(from.z);
        if (glm::length(crossing) > kDecided * (std::abs(from.z) + std::abs(to.z)))
            directions.push_back(glm::normalize(glm::dvec3(crossing.x, crossing.y, 0)));
    }
}

inline std::vector<glm::dvec3> directionsIn(Random& random, const Triangle& t) {
    std::vector<glm::dvec3> directions;
    for (size_t i = 0; i < 3; ++i) addDirections(directions, t[i], t[(i + 1) % 3], 24);
    if (glm::length(t[1] + t[2]) < 1e-3) return directions;
    for (int i = 0; i < 6; ++i)
        addDirections(directions, t[0], glm::normalize(glm::mix(t[1], t[2], random.uniform(0, 1))), 8);
    return directions;
}

// Those whose rays through a grid around the places given, and a little more, meet the triangle.
inline void addPixels(std::vector<glm::dvec3>& directions, Random& random, const Lens& lens,
                      const Triangle& triangle) {
    constexpr int kPixels = 16;
    glm::dvec2 least(1e9), most(-1e9);
    for (const glm::dvec3 direction : directions) {
        if (angleOf(direction) > lens.edge) continue;
        least = glm::min(least, lens.place(direction));
        most = glm::max(most, lens.place(direction));
    }
    const glm::dvec2 step = (most - least) / (kPixels - 4.0);
    const glm::dvec2 start = least - step * (1.5 + random.uniform(0, 1));
    for (int y = 0; y < kPixels && step.x >= 0; ++y)
        for (int x = 0; x < kPixels; ++x) {
            const glm::dvec2 place = start + step * glm::dvec2(x, y);
            if (glm::length(place) > lens.rim()) continue;
            const glm::dvec3 direction = lens.direction(place);
            if (meets(triangle, direction)) directions.push_back(direction);
        }
}

// Directions in which a lens sees, or with a wider edge would see, a triangle: along its edges, in it, and of
// pixels.
inline std::vector<glm::dvec3> seenOf(Random& random, const Lens& lens, const Triangle& triangle) {
    if (std::ranges::any_of(triangle, [](glm::dvec3 corner) { return corner == glm::dvec3(0); })) return {};
    const Triangle corners = directionsOf(triangle);
    std::vector<glm::dvec3> directions = directionsIn(random, corners);
    addPixels(directions, random, lens, corners);
    return directions;
}

inline std::string text(const Triangle& t, const Lens& lens) {
    std::string out = kModelNames[static_cast<size_t>(lens.model)];
    char buffer[400];
    for (const double c : lens.coefficients)
        out += (std::snprintf(buffer, sizeof buffer, " %.9g", c), buffer);
    std::snprintf(buffer, sizeof buffer,
                  " edge %.9g: {%.9g, %.9g, %.9g}, {%.9g, %.9g, %.9g}, {%.9g, %.9g, %.9g}", lens.edge, t[0].x,
                  t[0].y, t[0].z, t[1].x, t[1].y, t[1].z, t[2].x, t[2].y, t[2].z);
    return out + buffer;
}

}  // namespace curvewall::test
