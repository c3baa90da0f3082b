#include "calibration/projections/radial_lens.h"

#include "tests/support/round_trip.h"
#include "tests/support/test_walls.h"

#include <gtest/gtest.h>

namespace curvewall {
namespace {

using test::kPi;
constexpr glm::ivec2 kSizePx(900, 800);
constexpr glm::dvec2 kMiddlePx(450, 400);

// One unit of r in pixels, from the formula of each model.
struct Variant {
    RadialFunction function;
    double fovDeg;
    double edgeRadius;  // r at half of fovDeg

    double focalPx() const { return 400 / edgeRadius; }
    LensPtr lens() const { return circularLens(function, fovDeg * kPi / 180, kSizePx); }
};

const RadialFunction kPolynomial{RadialModel::polynomial, {1.1, 0.05, -0.09, 0, 0.004}};

std::vector<Variant> variants() {
    const double deg = kPi / 180;
    const auto polynomial = [](double t) {
        return 1.1 * t + 0.05 * t * t - 0.09 * std::pow(t, 3) + 0.004 * std::pow(t, 5);
    };
    return {
        {{RadialModel::orthographic}, 180, 1},
        {{RadialModel::orthographic}, 60, 0.5},
        {{RadialModel::stereographic}, 180, 2},
        {{RadialModel::stereographic}, 359.9, 2 * std::tan(359.9 / 4 * deg)},
        {{RadialModel::equisolid}, 180, std::sqrt(2.0)},
        {{RadialModel::equisolid}, 360, 2},
        {{RadialModel::equidistant}, 180, kPi / 2},
        {{RadialModel::equidistant}, 1, kPi / 360},
        {{RadialModel::equidistant}, 360, kPi},
        {kPolynomial, 180, polynomial(kPi / 2)},
        {kPolynomial, 230, polynomial(115 * deg)},
        {{RadialModel::polynomial, {0, 1}}, 200, 100 * deg * 100 * deg},  // flat in the middle
    };
}

TEST(RadialLens, EveryPixelOfTheCircleComesBackAndNoneOutsideIsShown) {
    test::Random random(1);
    for (const Variant& v : variants()) {
        const LensProjection projection(v.lens(), test::anyOrientation(random));
        const auto result = test::roundTrip(projection, kSizePx, 2,
                                            [](glm::dvec2 px) { return glm::distance(px, kMiddlePx) > 400; });
        EXPECT_LT(result.worstPx, 1e-6) << static_cast<int>(v.function.model) << ' ' << v.fovDeg;
        EXPECT_EQ(result.wrongHoles, 0);
        EXPECT_NEAR(result.holes, 100'000 * (1 - kPi * 400 * 400 / (900 * 800)), 800);
    }
}

// The inverse of each map as textbooks on map projections write it, without angles.
std::optional<glm::dvec3> closedForm(RadialModel model, glm::dvec2 p) {
    const double r2 = glm::dot(p, p);
    switch (model) {
        case RadialModel::orthographic:
            return glm::dvec3(p, -std::sqrt(1 - r2));
        case RadialModel::stereographic:
            return glm::dvec3(4.0 * p, r2 - 4) / (4 + r2);
        case RadialModel::equisolid:
            return glm::dvec3(p * std::sqrt(1 - r2 / 4), r2 / 2 - 1);
        case RadialModel::equidistant:
        case RadialModel::polynomial:
            break;
    }
    return std::nullopt;
}

TEST(RadialLens, DirectionsAreThoseOfTheClosedForms) {
    test::Random random(3);
    for (const Variant& v : variants()) {
        const LensPtr lens = v.lens();
        for (int i = 0; i < 20'000; ++i) {
            const glm::dvec2 px = random.pixel(kSizePx);
            const auto direction = lens->direction(px);
            if (!direction) continue;
            const glm::dvec2 p = glm::dvec2(px.x - 450, 400 - px.y) / v.focalPx();
            ASSERT_NEAR(glm::length(*direction), 1, 1e-14);
            // The square root of the orthographic form is worth 1e-7 at the edge.
            if (const auto expected = closedForm(v.function.model, p)) {
                ASSERT_LT(glm::distance(*direction, *expected), 1e-7);
                ASSERT_LT(glm::length(glm::dvec2(*direction - *expected)), 1e-11);
            } else {
                const double t = std::atan2(glm::length(glm::dvec2(*direction)), -direction->z);
                const auto& c = v.function.coefficients;
                const double r = v.function.model == RadialModel::equidistant
                                     ? t
                                     : c[0] * t + c[1] * t * t + c[2] * t * t * t + c[4] * std::pow(t, 5);
                ASSERT_NEAR(r, glm::length(p), 1e-12);
                ASSERT_NEAR(direction->x * p.y, direction->y * p.x, 1e-12);
                ASSERT_GE(glm::dot(glm::dvec2(*direction), p), -1e-12);
            }
        }
    }
}

TEST(RadialLens, TheEdgeOfTheCircleIsHalfTheFieldOfView) {
    for (const Variant& v : variants()) {
        const LensPtr lens = v.lens();
        const double edge = v.fovDeg * kPi / 360;
        const glm::dvec3 right(std::sin(edge), 0, -std::cos(edge)), up(0, std::sin(edge), -std::cos(edge));
        EXPECT_LT(glm::distance(lens->positions(right).at(0), glm::dvec2(850, 400)), 1e-6);
        EXPECT_LT(glm::distance(lens->positions(7.0 * up).at(0), glm::dvec2(450, 0)), 1e-6);
        ASSERT_TRUE(lens->direction({850, 400}) && lens->direction({450, 0}));
        EXPECT_LT(glm::distance(*lens->direction({850, 400}), right), 3e-8);  // sin is flat at 90 degrees
        EXPECT_FALSE(lens->direction({850.001, 400}));
        EXPECT_FALSE(lens->direction({450, -0.001}));
    }
}

TEST(RadialLens, RaysBeyondTheCircleHavePositionsAsFarAsTheFormulaHolds) {
    const auto at = [](double deg) {
        return glm::dvec3(std::sin(deg * kPi / 180), 0, -std::cos(deg * kPi / 180));
    };
    const auto lens = [](RadialFunction function) { return circularLens(function, kPi / 2, kSizePx); };

    const LensPtr orthographic = lens({RadialModel::orthographic});
    EXPECT_NEAR(orthographic->positions(at(80)).at(0).x,
                450 + 400 * std::sin(80 * kPi / 180) / std::sin(kPi / 4), 1e-9);
    for (const double deg : {90.001, 100.0, 135.0, 180.0})
        EXPECT_TRUE(orthographic->positions(at(deg)).empty());

    const LensPtr stereographic = lens({RadialModel::stereographic});
    EXPECT_NEAR(stereographic->positions(at(179)).at(0).x,
                450 + 400 * std::tan(89.5 * kPi / 180) / std::tan(kPi / 8), 1e-6);
    EXPECT_TRUE(stereographic->positions({0, 0, 1}).empty());

    EXPECT_NEAR(lens({RadialModel::equidistant})->positions(at(180)).at(0).x, 450 + 400 * 4, 1e-9);
    EXPECT_NEAR(lens({RadialModel::equisolid})->positions(at(180)).at(0).x, 450 + 400 / std::sin(kPi / 8),
                1e-9);

    const LensPtr turning = lens({RadialModel::polynomial, {1, 0, -1 / (3 * std::pow(100 * kPi / 180, 2))}});
    EXPECT_EQ(turning->positions(at(99.999)).size(), 1u);
    EXPECT_TRUE(turning->positions(at(100.001)).empty());
}

TEST(RadialFunction, LimitsAreWhereTheRadiusStopsGrowing) {
    const auto limit = [](std::array<double, 9> c) {
        return RadialFunction{RadialModel::polynomial, c}.limitRad();
    };
    EXPECT_DOUBLE_EQ(limit({1}), kPi);
    EXPECT_DOUBLE_EQ(limit({0, 1}), kPi);
    EXPECT_NEAR(limit({1, -0.25}), 2, 1e-14);
    EXPECT_NEAR(limit({1, 0, -1.0 / 3}), 1, 1e-14);
    EXPECT_NEAR(limit({1, 0, -1.0 / 3, 0, 10}), kPi, 1e-14);
    EXPECT_EQ(limit({-1, 2}), 0);
    EXPECT_EQ(limit({}), 0);
}

TEST(CurvilinearLens, IsThePerspectiveViewWithTheMeanOfDepthAndDistance) {
    for (const double fovDeg : {30.0, 90.0, 130.0, 179.0}) {
        const LensPtr lens = curvilinearLens(fovDeg * kPi / 180, kSizePx);
        const double focalPx = 450 / std::tan(fovDeg * kPi / 360);
        test::Random random(4);
        for (int i = 0; i < 20'000; ++i) {
            const glm::dvec3 point = random.uniform(0.1, 10) * random.direction();
            const double depth = (-point.z + glm::length(point)) / 2;
            if (depth < 1e-3) continue;
            const glm::dvec2 px = lens->positions(point).at(0);
            const glm::dvec2 expected(450 + focalPx * point.x / depth, 400 - focalPx * point.y / depth);
            ASSERT_LT(glm::distance(px, expected), 1e-9 * (1 + glm::length(expected)));
        }
    }
}

TEST(CurvilinearLens, FillsTheRectangleAndEveryPixelComesBack) {
    test::Random random(5);
    for (const double fovDeg : {1.0, 60.0, 130.0, 179.9}) {
        const LensProjection projection(curvilinearLens(fovDeg * kPi / 180, kSizePx),
                                        test::anyOrientation(random));
        const auto result = test::roundTrip(projection, kSizePx, 6);
        EXPECT_LT(result.worstPx, 1e-6);
        EXPECT_EQ(result.holes, 0);
    }
}

}  // namespace
}  // namespace curvewall
