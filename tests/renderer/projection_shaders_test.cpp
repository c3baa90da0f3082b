// The formulas of shaders/projections/ run on the GPU in single precision and in C++ in double precision.
// Inputs are single precision numbers, so that both start from the same ones; each bound says how much of the
// difference single precision explains.

#include "calibration/projections/projection_maths.h"
#include "tests/support/gpu_formulas.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>

namespace curvewall {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kWithAtan = 5e-6;

class ProjectionShaders : public test::GpuFormulas {
protected:
    ProjectionShaders()
        : GpuFormulas({"projections/root_ahead", "projections/cylinder", "projections/equirectangular",
                       "projections/pinhole", "projections/radial", "projections/sphere",
                       "projections/sphere_slices"}) {}
};

glm::vec4 anyDirection(test::Random& random) {
    return {glm::vec3(random.direction() * random.uniform(0.2, 5)), 0};
}

std::function<glm::vec4(test::Random&)> anyAngles(double most0, double most1) {
    return [=](test::Random& random) {
        return glm::vec4(random.uniform(-most0, most0), random.uniform(-most1, most1), 0, 0);
    };
}

// Angles that jump by a turn are compared on the circle.
glm::dvec4 onCircle(glm::dvec2 angles) {
    return {std::cos(angles.x), std::sin(angles.x), std::cos(angles.y), std::sin(angles.y)};
}
const std::string kOnCircle = "return vec4(cos(a.x), sin(a.x), cos(a.y), sin(a.y));";

TEST_F(ProjectionShaders, Cylinder) {
    EXPECT_LT(
        difference(
            "return vec4(cylinderPoint(2.0, v.x, v.y), 0.0);",
            [](glm::dvec4 v) { return glm::dvec4(maths::cylinderPoint(2, v.x, v.y), 0); }, anyAngles(kPi, 3)),
        2e-6);
    EXPECT_LT(difference(
                  "vec2 p = cylinderPosition(v.xyz); return vec4(cos(p.x), sin(p.x), p.y, "
                  "cylinderDistance(2.0, vec3(0.5, 0.3, -1.0), normalize(v.xyz) + vec3(0.0, 0.0, 2.0)));",
                  [](glm::dvec4 v) {
                      const glm::dvec2 p = maths::cylinderPosition(v);
                      return glm::dvec4(
                          std::cos(p.x), std::sin(p.x), p.y,
                          maths::cylinderDistance(2, {0.5, 0.3, -1},
                                                  glm::normalize(glm::dvec3(v)) + glm::dvec3(0, 0, 2)));
                  },
                  anyDirection),
              1e-5);
}

TEST_F(ProjectionShaders, Equirectangular) {
    EXPECT_LT(difference(
                  "return vec4(equirectangularDirection(v.xy), 0.0);",
                  [](glm::dvec4 v) { return glm::dvec4(maths::equirectangularDirection(v), 0); },
                  anyAngles(4 * kPi, kPi / 2)),
              2e-6);  // 13 radians are known to 5e-7
    EXPECT_LT(difference(
                  "vec2 a = equirectangularAngles(v.xyz);" + kOnCircle,
                  [](glm::dvec4 v) { return onCircle(maths::equirectangularAngles(v)); }, anyDirection),
              kWithAtan);
}

TEST_F(ProjectionShaders, SphereSlices) {
    EXPECT_LT(
        difference(
            "return vec4(sphereSlicesDirection(v.xy), 0.0);",
            [](glm::dvec4 v) { return glm::dvec4(maths::sphereSlicesDirection(v), 0); }, anyAngles(kPi, kPi)),
        1e-6);
    EXPECT_LT(difference(
                  "vec2 a = sphereSlicesAngles(v.xyz);" + kOnCircle,
                  [](glm::dvec4 v) { return onCircle(maths::sphereSlicesAngles(v)); }, anyDirection),
              kWithAtan);
}

TEST_F(ProjectionShaders, Sphere) {
    // From anywhere inside; distances of up to 2 radii.
    EXPECT_LT(difference(
                  "return vec4(sphereDistance(3.0, v.w * vec3(0.6, 0.0, 0.8), normalize(v.xyz)));",
                  [](glm::dvec4 v) {
                      return glm::dvec4(maths::sphereDistance(3, v.w * glm::dvec3(0.6, 0, 0.8),
                                                              glm::normalize(glm::dvec3(v))));
                  },
                  [](test::Random& random) {
                      return glm::vec4(glm::vec3(random.direction()), random.uniform(0, 2.9));
                  }),
              2e-5);
}

TEST_F(ProjectionShaders, RadialBothWays) {
    struct Model {
        int model;
        double mostRad;
        double bound;  // the slope of the map multiplies what single precision loses
    };
    const std::array<double, maths::kRadialTerms> doubles{1.125, 0.0625, -0.09375, 0, 0.00390625};
    Terms terms{};
    std::ranges::copy(doubles, terms.begin());
    const std::string coefficients =
        "float c[kRadialTerms]; for (int i = 0; i < kRadialTerms; ++i) c[i] = terms[i];";
    for (const auto& [model, mostRad, bound] :
         {Model{maths::kOrthographic, kPi / 2, kWithAtan}, Model{maths::kStereographic, 2.8, 5e-5},
          Model{maths::kEquisolid, kPi, kWithAtan}, Model{maths::kEquidistant, kPi, kWithAtan},
          Model{maths::kPolynomial, 2.0, kWithAtan}}) {
        const std::string withModel = coefficients + "const int model = " + std::to_string(model) +
                                      "; const float most = " + std::to_string(mostRad) + ";";
        const auto inside = [mostRad = mostRad](test::Random& random) {
            const double t = random.uniform(0, 0.999 * mostRad), phi = random.uniform(-kPi, kPi);
            return glm::vec4(std::sin(t) * std::cos(phi), std::sin(t) * std::sin(phi), -std::cos(t), 0);
        };
        EXPECT_LT(difference(
                      withModel + "return vec4(radialPosition(model, c, v.xyz), 0.0, 0.0);",
                      [&, model = model](glm::dvec4 v) {
                          return glm::dvec4(maths::radialPosition(model, doubles.data(), v), 0, 0);
                      },
                      inside, terms),
                  bound)
            << model;
        const double most = maths::radialRadius(model, doubles.data(), mostRad);
        const auto positions = [&](test::Random& random) {
            // Where sin is flat, the angle is known to the root of what the radius is known to.
            const double r = 0.99 * most * std::sqrt(random.uniform(0, 1)), phi = random.uniform(-kPi, kPi);
            return glm::vec4(r * std::cos(phi), r * std::sin(phi), 0, 0);
        };
        EXPECT_LT(difference(
                      withModel + "return vec4(radialDirection(model, c, v.xy, most), 0.0);",
                      [&, model = model, mostRad = mostRad](glm::dvec4 v) {
                          return glm::dvec4(maths::radialDirection(model, doubles.data(), v, mostRad), 0);
                      },
                      positions, terms),
                  2e-5)
            << model;
    }
}

TEST_F(ProjectionShaders, PinholeBothWays) {
    // A strong barrel, all terms; one-to-one to beyond 0.7.
    const std::array<double, maths::kPinholeTerms> doubles{
        -0.25,     0.0625,      0.0009765625, -0.001953125, -0.0078125,  0.015625,
        0.0078125, 0.001953125, 0.00390625,   -0.001953125, 0.001953125, 0.0009765625};
    Terms terms{};
    std::ranges::transform(doubles, terms.begin(), [](double k) { return static_cast<float>(k); });
    const std::string coefficients =
        "float k[kPinholeTerms]; for (int i = 0; i < kPinholeTerms; ++i) k[i] = terms[i];";
    const double mostRadius = 0.75;
    const glm::dmat3 tilt(0.99, 0.01, -0.05, 0, 1.0, 0.04, 0.02, -0.03, 1.0);
    EXPECT_LT(difference(
                  coefficients + "return vec4(pinholeDistorted(k, v.xy), 0.0, 0.0);",
                  [&](glm::dvec4 v) { return glm::dvec4(maths::pinholeDistorted(doubles.data(), v), 0, 0); },
                  anyAngles(0.7, 0.7), terms),
              1e-6);
    EXPECT_LT(difference(
                  coefficients + "return pinholeJacobian(k, v.xy);",
                  [&](glm::dvec4 v) { return maths::pinholeJacobian(doubles.data(), v); },
                  anyAngles(0.7, 0.7), terms),
              2e-6);
    EXPECT_LT(difference(
                  coefficients + "return vec4(pinholeUndistorted(k, v.xy, 0.75, 1e-6), 0.0);",
                  [&](glm::dvec4 v) {
                      return glm::dvec4(maths::pinholeUndistorted(doubles.data(), v, mostRadius, 1e-12), 0);
                  },
                  [&](test::Random& random) {
                      const double r = 0.7 * std::sqrt(random.uniform(0, 1)), phi = random.uniform(-kPi, kPi);
                      return glm::vec4(glm::vec2(maths::pinholeDistorted(
                                           doubles.data(), {r * std::cos(phi), r * std::sin(phi)})),
                                       0, 0);
                  },
                  terms),
              1e-5);  // the tolerance of 1e-6 over the smallest slope, 0.3
    EXPECT_LT(
        difference(
            "return vec4(pinholeTilted(mat3(0.99, 0.01, -0.05, 0.0, 1.0, 0.04, 0.02, -0.03, 1.0), v.xy), "
            "0.0);",
            [&](glm::dvec4 v) { return glm::dvec4(maths::pinholeTilted(tilt, v), 0); }, anyAngles(1, 1)),
        1e-6);
}

}  // namespace
}  // namespace curvewall
