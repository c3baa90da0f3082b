// Triangles that are hard to bound, through every round lens: which pixels bounded-raycast covers, against a
// test of every pixel's ray in double precision, written apart from the renderer.

#include "calibration/pieces/pixel_rays.h"
#include "renderer/names.h"
#include "tests/renderer/seen_triangles.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/lens_walls.h"
#include "tests/support/random_numbers.h"
#include "tests/support/rendering.h"
#include "tests/support/test_scenes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

namespace curvewall {
namespace {

using test::kPi;
using Corners = std::array<glm::vec3, 3>;
constexpr std::array kAllBounds{BoundingShape::triangle, BoundingShape::quad, BoundingShape::genericQuad};

class BoundedTriangles : public test::GlTest, public testing::WithParamInterface<test::LensKind> {
protected:
    // Returns how many fragments there are for sure.
    int expectExactCoverage(const std::vector<Corners>& triangles, const Orientation& orientation = {},
                            glm::ivec2 sizePx = {192, 160});
    void expectReferencePicture(const Corners& triangle);

    Renderer renderer_;
};

INSTANTIATE_TEST_SUITE_P(EveryLens, BoundedTriangles, testing::ValuesIn(test::lensKinds()),
                         [](const auto& lens) { return lens.param.name; });

// Signs of three volumes, and what is nearer than every method's near limit is cut. Nothing where single
// precision may see it otherwise: so near to an edge, to the limit, or to the plane through the eye.
std::optional<bool> meets(const Corners& triangle, glm::dvec3 ray) {
    constexpr double kNearM = 1e-5, kEdgeDoubt = 1e-5, kPlaneDoubt = 1e-6;
    std::array<glm::dvec3, 3> p{triangle[0], triangle[1], triangle[2]};
    int above = 0, below = 0;
    for (size_t i = 0; i < 3; ++i) {
        const glm::dvec3 from = p[i], to = p[(i + 1) % 3], plane = glm::cross(from, to - from);
        const double nearer = std::min(glm::length(from), glm::length(to)), length = glm::distance(from, to);
        const double doubt = std::max(kEdgeDoubt * glm::length(plane), kPlaneDoubt * nearer * length);
        above += glm::dot(ray, plane) > doubt;
        below += glm::dot(ray, plane) < -doubt;
    }
    if (above > 0 && below > 0) return false;

    const auto nearest =
        std::ranges::min_element(p, {}, [](glm::dvec3 corner) { return glm::length(corner); });
    std::ranges::rotate(p, nearest);
    const glm::dvec3 second = p[1] - p[0], third = p[2] - p[0], normal = glm::cross(second, third);
    const double size = glm::length(normal);
    const double side = glm::dot(p[0], normal) / size;
    const double beyondNear = std::abs(side) - kNearM * std::abs(glm::dot(ray, normal)) / size;
    const double doubt = kPlaneDoubt * glm::length(p[0]) * glm::length(second) * glm::length(third) / size;
    if (!(std::abs(side) >= doubt)) return std::nullopt;
    if ((side > 0 ? below : above) > 0 || beyondNear < -doubt) return false;
    if (above + below < 3 || beyondNear < doubt) return std::nullopt;
    return true;
}

RenderRequest requestFor(const test::LensKind& kind, const std::vector<Corners>& triangles,
                         const Orientation& orientation, glm::ivec2 sizePx) {
    Scene scene;
    startMaterial(scene, plainMaterial({0.2, 0.9, 0.4}));
    for (const Corners& triangle : triangles) addTriangle(scene, triangle);
    RenderRequest request = test::requestFor(test::lensWall(kind, sizePx, orientation), std::move(scene));
    request.method = Method::boundedRaycast;
    return request;
}

int BoundedTriangles::expectExactCoverage(const std::vector<Corners>& triangles,
                                          const Orientation& orientation, glm::ivec2 sizePx) {
    RenderRequest request = requestFor(GetParam(), triangles, orientation, sizePx);
    request.output = OutputKind::coverage;
    const PixelRays rays(*request.wall->displays[0].projection, sizePx);
    std::vector<int> least, most;
    for (int y = 0; y < sizePx.y; ++y)
        for (int x = 0; x < sizePx.x; ++x) {
            least.push_back(0);
            most.push_back(0);
            if (!rays.has({x, y})) continue;
            const glm::dvec3 ray = glm::normalize(rays.at({x, y}));
            for (const Corners& triangle : triangles) {
                const std::optional<bool> met = meets(triangle, ray);
                least.back() += met.value_or(false);
                most.back() += met.value_or(true);
            }
        }
    for (const BoundingShape bounds : kAllBounds) {
        request.bounds = bounds;
        const Frame coverage = renderer_.render(request).frame;
        int missed = 0, tooMany = 0;
        for (size_t i = 0; i < coverage.texels.size(); ++i) {
            missed += static_cast<int>(coverage.texels[i]) < least[i];
            tooMany += static_cast<int>(coverage.texels[i]) > most[i];
        }
        EXPECT_EQ(missed, 0) << nameOf(bounds);
        EXPECT_EQ(tooMany, 0) << nameOf(bounds);
    }
    return std::accumulate(least.begin(), least.end(), 0);
}

void BoundedTriangles::expectReferencePicture(const Corners& triangle) {
    RenderRequest request = requestFor(GetParam(), {triangle}, {}, {192, 160});
    const Frame expected = test::referenceOf(request).frame;
    for (const BoundingShape bounds : kAllBounds) {
        request.bounds = bounds;
        EXPECT_LT(compareColor(renderer_.render(request).frame, expected).shareOff, 5e-5);
    }
}

// What lies `angleDeg` off the axis at an azimuth.
glm::vec3 at(double angleDeg, double azimuthDeg, double distanceM = 3) {
    const double angle = angleDeg * kPi / 180, azimuth = azimuthDeg * kPi / 180;
    return glm::vec3(distanceM * glm::dvec3(std::sin(angle) * std::cos(azimuth),
                                            std::sin(angle) * std::sin(azimuth), -std::cos(angle)));
}

glm::vec3 float3(glm::dvec3 v) { return glm::vec3(v); }

TEST_P(BoundedTriangles, OneCornerBeyondTheBorder) {  // figure 4 (a)
    const double edge = std::min(GetParam().fovDeg / 2, 90.0);
    for (const double azimuth : {0.0, 77.0, 200.0}) {
        const Corners triangle{at(0.5 * edge, azimuth), at(0.6 * edge, azimuth + 70),
                               at(edge + 35, azimuth + 20)};
        expectExactCoverage({triangle});
        expectReferencePicture(triangle);
    }
}

TEST_P(BoundedTriangles, TwoCornersBeyondTheBorder) {  // figure 4 (b)
    const double edge = std::min(GetParam().fovDeg / 2, 90.0);
    for (const double azimuth : {0.0, 77.0, 200.0}) {
        const Corners triangle{at(0.4 * edge, azimuth + 30), at(edge + 30, azimuth - 40),
                               at(edge + 20, azimuth + 80)};
        expectExactCoverage({triangle});
        expectReferencePicture(triangle);
    }
}

TEST_P(BoundedTriangles, AnglesOfMoreThanHalfATurn) {  // figure 4 (c)
    // Thin, along the horizon: the middle corner lies inside the bow of the edge opposite.
    const double edge = std::min(GetParam().fovDeg / 2, 90.0);
    for (const double azimuth : {0.0, 77.0, 200.0})
        for (const double lift : {-6.0, -2.0, 2.0}) {
            const Corners triangle{at(0.95 * edge, azimuth - 60), at(0.95 * edge, azimuth + 60),
                                   at(0.93 * edge + lift, azimuth + 3)};
            expectExactCoverage({triangle});
            expectReferencePicture(triangle);
        }
}

TEST_P(BoundedTriangles, AllThreeCornersBeyondTheBorder) {
    // Around the lens, across its axis, and beside it.
    expectExactCoverage({Corners{at(100, 10), at(110, 130), at(95, 250)}});
    expectExactCoverage({Corners{at(120, 0), at(120, 5), at(120, 182)}});
    expectExactCoverage({Corners{at(150, 0), at(150, 100), at(130, 50)}});
}

TEST_P(BoundedTriangles, RandomOnesOfAllSizes) {
    test::Random random(7);
    for (const double size : {0.02, 0.3, 2.0, 30.0}) {
        std::vector<Corners> triangles;
        while (triangles.size() < 100) {
            const glm::dvec3 centre = 3.0 * random.direction();
            Corners triangle;
            for (glm::vec3& corner : triangle) corner = float3(centre + random.inBox(size));
            triangles.push_back(triangle);
        }
        expectExactCoverage(triangles, test::kTurned);
    }
}

TEST_P(BoundedTriangles, Slivers) {
    test::Random random(8);
    std::vector<Corners> triangles;
    while (triangles.size() < 150) {
        const glm::dvec3 a = 3.0 * random.direction(), b = 3.0 * random.direction();
        const double share = random.uniform(-0.2, 1.2), width = std::pow(10, random.uniform(-4, -1));
        triangles.push_back(
            {float3(a), float3(b), float3(glm::mix(a, b, share) + width * random.direction())});
    }
    expectExactCoverage(triangles);
}

TEST_P(BoundedTriangles, NearTheEye) {
    // Planes a few tenths of a millimetre beside the eye, of triangles metres wide.
    test::Random random(9);
    std::vector<Corners> triangles;
    while (triangles.size() < 60) {
        const glm::dvec3 normal = random.direction(),
                         right = glm::normalize(glm::cross(normal, random.direction())),
                         up = glm::cross(normal, right);
        const double distance = std::pow(10, random.uniform(-3.5, -0.5));
        Corners triangle;
        for (glm::vec3& corner : triangle)
            corner = float3(distance * normal + random.uniform(-4, 4) * right + random.uniform(-4, 4) * up);
        triangles.push_back(triangle);
    }
    expectExactCoverage(triangles);
}

// More than 100,000 over all lenses.
TEST_P(BoundedTriangles, NoneOfManyRandomOnesIsMissed) {
    constexpr int kBatches = 53, kTriangles = 100;
    test::Random random(11);
    int fragments = 0;
    for (int i = 0; i < kBatches; ++i) {
        std::vector<Corners> triangles;
        while (triangles.size() < kTriangles) {
            const test::Triangle triangle = test::anyTriangle(random);
            triangles.push_back({float3(triangle[0]), float3(triangle[1]), float3(triangle[2])});
        }
        fragments += expectExactCoverage(triangles, {}, {96, 80});
    }
    EXPECT_GT(fragments, 100'000);
}

TEST_P(BoundedTriangles, WithTheEyeInTheirPlane) {
    // Exactly; seen edge on, they show nothing, even around the eye.
    expectReferencePicture({float3({-5, 0, -5}), float3({5, 0, -5}), float3({0, 0, 5})});
    expectReferencePicture({float3({-5, 0, -5}), float3({5, 0, -5}), float3({0, 0, -1})});
    expectReferencePicture({float3({0, -2, -3}), float3({0, 4, -3}), float3({0, 1, 8})});
}

TEST_P(BoundedTriangles, HardOnesTogetherGiveTheReferencePicture) {
    // Not those whose corners are more than a million times farther than others: there the reference, too,
    // rounds.
    test::Random random(13);
    Scene scene;
    startMaterial(scene, plainMaterial({0.2, 0.9, 0.4}));
    const auto add = [&](const test::Triangle& triangle) {
        addTriangle(scene, {float3(triangle[0]), float3(triangle[1]), float3(triangle[2])});
    };
    for (int i = 0; i < 40; ++i) {
        const double azimuth = random.uniform(0, 2 * kPi);
        const glm::dvec3 horizon(std::cos(azimuth), std::sin(azimuth), 0);
        add(test::around(random, random.uniform(1, 9) * horizon, 0.5, 1));
        add(test::anySliver(random));
        add(test::anyCrescent(random));
    }
    for (const glm::dvec3 originM : {glm::dvec3(0), glm::dvec3(1e6, -2e5, 3e6)}) {
        scene.originM = originM;
        RenderRequest request =
            test::requestFor(test::lensWall(GetParam(), {192, 160}, test::kTurned), scene, {originM, {}});
        request.method = Method::boundedRaycast;
        const Frame expected = test::referenceOf(request).frame;
        for (const BoundingShape bounds : kAllBounds) {
            request.bounds = bounds;
            EXPECT_LT(compareColor(renderer_.render(request).frame, expected).shareOff, 5e-4)
                << nameOf(bounds);
        }
    }
}

TEST_P(BoundedTriangles, AlongTheBorderAndTheHorizon) {
    // Corners on the border of the picture and in the plane across the axis, exactly and by a hair.
    test::Random random(10);
    const double edge = GetParam().fovDeg / 2;
    std::vector<Corners> triangles;
    while (triangles.size() < 100) {
        Corners triangle;
        for (glm::vec3& corner : triangle) {
            const double around = random.uniform(0, 1) < 0.5 ? edge : 90;
            const double off = random.uniform(0, 1) < 0.3 ? 0 : std::pow(10, random.uniform(-5, 1));
            corner = at(around + (random.uniform(0, 1) < 0.5 ? off : -off), random.uniform(0, 360),
                        random.uniform(0.5, 5));
        }
        triangles.push_back(triangle);
    }
    expectExactCoverage(triangles);
}

}  // namespace
}  // namespace curvewall
