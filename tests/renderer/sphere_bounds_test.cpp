// The bounds of projected spheres against points of those spheres, found without a formula for tangents.

#include "renderer/sphere_bounds.h"

#include "tests/support/gpu_formulas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace curvewall {
namespace {

constexpr double kPi = std::numbers::pi;

struct Frame3 {
    glm::dvec3 right, down, ahead;
};

// Of length one, at right angles.
Frame3 anyFrame(test::Random& random) {
    const glm::dvec3 ahead = random.direction();
    const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::cross(random.direction(), ahead)));
    return {right, glm::cross(ahead, right), ahead};
}

struct Sphere {
    glm::dvec3 centre;
    double radius = 0;
};

// All kinds: around the eye, cut by the near plane, behind it, touching either, far and small.
Sphere anySphere(test::Random& random, const Frame3& frame, double near) {
    Sphere sphere{random.inBox(3), std::exp(random.uniform(-5, 1.5))};
    const double kind = random.uniform(0, 1), z = glm::dot(frame.ahead, sphere.centre);
    if (kind < 0.1)  // the eye just outside or just inside
        sphere.radius = glm::length(sphere.centre) * (1 + random.uniform(-1e-3, 1e-3));
    else if (kind < 0.2)  // the near plane just cuts a cap off, or all but a cap
        sphere.centre += frame.ahead * (near - z + sphere.radius * (1 + random.uniform(-1e-3, 1e-3)));
    else if (kind < 0.3)
        sphere.centre += frame.ahead * (near - z - sphere.radius * (1 + random.uniform(-1e-3, 1e-3)));
    return sphere;
}

// The greatest (axis . p) / (ahead . p) that a search over the part of the surface with ahead . p >= near
// finds. That part is a cap about `ahead`, flattened to a disc of radius one whose rim is the circle in the
// near plane.
class GreatestPlace {
public:
    GreatestPlace(const Sphere& sphere, glm::dvec3 axis, glm::dvec3 ahead, double near)
        : sphere_(sphere), axis_(axis), ahead_(ahead), across_(glm::cross(ahead, axis)), near_(near) {
        const double below = (near - glm::dot(ahead, sphere.centre)) / sphere.radius;
        capRad_ = std::acos(glm::clamp(below, -1.0, 1.0));
    }

    double find() const {
        constexpr int kStarts = 400;
        glm::dvec2 best(0);
        for (int i = 0; i < kStarts; ++i) {
            const double radius = std::sqrt((i + 0.5) / kStarts), turn = i * kPi * (3 - std::sqrt(5.0));
            const glm::dvec2 start = radius * glm::dvec2(std::cos(turn), std::sin(turn));
            if (placeOf(start) > placeOf(best)) best = start;
        }
        for (double step = 0.2; step > 1e-9;) {
            const glm::dvec2 next = bestAround(best, step);
            if (placeOf(next) > placeOf(best))
                best = next;
            else
                step /= 2;
        }
        return placeOf(best);
    }

private:
    double placeOf(glm::dvec2 onDisc) const {
        const double fromAhead = glm::length(onDisc) * capRad_;
        const glm::dvec2 side = glm::length(onDisc) > 0 ? glm::normalize(onDisc) : glm::dvec2(1, 0);
        const glm::dvec3 p =
            sphere_.centre + sphere_.radius * (std::cos(fromAhead) * ahead_ +
                                               std::sin(fromAhead) * (side.x * axis_ + side.y * across_));
        return glm::dot(axis_, p) / std::max(glm::dot(ahead_, p), near_);
    }

    glm::dvec2 bestAround(glm::dvec2 middle, double step) const {
        glm::dvec2 best = middle;
        for (int i = 0; i < 16; ++i) {
            glm::dvec2 next = middle + step * glm::dvec2(std::cos(i * kPi / 8), std::sin(i * kPi / 8));
            next /= std::max(glm::length(next), 1.0);
            if (placeOf(next) > placeOf(best)) best = next;
        }
        return best;
    }

    Sphere sphere_;
    glm::dvec3 axis_, ahead_, across_;
    double near_;
    double capRad_ = 0;
};

TEST(SphereBounds, HoldTheSphereAndTouchIt) {
    test::Random random(1);
    int nothing = 0, eyeInside = 0, cut = 0;
    for (int i = 0; i < 3000; ++i) {
        const double near = random.uniform(0.01, 1);
        const Frame3 frame = anyFrame(random);
        const Sphere sphere = anySphere(random, frame, near);
        const maths::AxisBounds bounds =
            maths::sphereAxisBounds(sphere.centre, sphere.radius, frame.right, frame.ahead, near);
        const double z = glm::dot(frame.ahead, sphere.centre);
        if (z + sphere.radius <= near) {
            ++nothing;
            ASSERT_EQ(bounds.kind, maths::kSphereNothing);
            continue;
        }
        eyeInside += glm::length(sphere.centre) < sphere.radius;
        cut += z - sphere.radius < near;
        ASSERT_EQ(bounds.kind, maths::kSphereSeen);
        const double most = GreatestPlace(sphere, frame.right, frame.ahead, near).find();
        const double least = -GreatestPlace(sphere, -frame.right, frame.ahead, near).find();
        // Compared as angles: places are as large as 1 / near.
        ASSERT_GE(std::atan(bounds.most), std::atan(most) - 1e-12) << i;
        ASSERT_LE(std::atan(bounds.least), std::atan(least) + 1e-12) << i;
        ASSERT_LE(std::atan(bounds.most), std::atan(most) + 1e-6) << i;
        ASSERT_GE(std::atan(bounds.least), std::atan(least) - 1e-6) << i;
    }
    EXPECT_GT(nothing, 300);
    EXPECT_GT(eyeInside, 200);
    EXPECT_GT(cut, 300);
}

TEST(SphereBounds, SidesAreOpenWithoutANearPlane) {
    test::Random random(2);
    int open = 0, closed = 0;
    for (int i = 0; i < 2000; ++i) {
        const Frame3 frame = anyFrame(random);
        const Sphere sphere = anySphere(random, frame, 0);
        const maths::AxisBounds bounds =
            maths::sphereAxisBounds(sphere.centre, sphere.radius, frame.right, frame.ahead, 0);
        if (bounds.kind == maths::kSphereNothing) {
            EXPECT_LE(glm::dot(frame.ahead, sphere.centre) + sphere.radius, 0);
            continue;
        }
        const double most = GreatestPlace(sphere, frame.right, frame.ahead, 1e-12).find();
        const double least = -GreatestPlace(sphere, -frame.right, frame.ahead, 1e-12).find();
        EXPECT_EQ((bounds.kind & maths::kSphereOpenAbove) != 0, most > 1e8) << most;
        EXPECT_EQ((bounds.kind & maths::kSphereOpenBelow) != 0, least < -1e8) << least;
        // The search creeps along the rim, where what is nearly level with the eye is steep.
        ASSERT_NEAR(std::atan(bounds.most), std::atan(most), 1e-5) << i;
        ASSERT_NEAR(std::atan(bounds.least), std::atan(least), 1e-5) << i;
        ++(bounds.kind == maths::kSphereSeen ? closed : open);
    }
    EXPECT_GT(open, 200);
    EXPECT_GT(closed, 200);
}

TEST(SphereBounds, TangentCasesByHand) {
    const glm::dvec3 right(1, 0, 0), ahead(0, 0, -1);
    const auto bounds = [&](glm::dvec3 centre, double radius, double near) {
        return maths::sphereAxisBounds(centre, radius, right, ahead, near);
    };
    // Straight ahead: the tangent of asin(3 / 5).
    EXPECT_NEAR(bounds({0, 0, -5}, 3, 0).most, 0.75, 1e-15);
    EXPECT_NEAR(bounds({0, 0, -5}, 3, 0).least, -0.75, 1e-15);
    // What lies above or below the plane of axis and eye alters nothing.
    EXPECT_NEAR(bounds({0, 40, -5}, 3, 0).most, 0.75, 1e-15);
    // The near plane through the tangent points, and just behind them: nothing of the bounds is cut.
    EXPECT_NEAR(bounds({0, 0, -5}, 3, 3.2).most, 0.75, 1e-12);
    EXPECT_LT(bounds({0, 0, -5}, 3, 3.3).most, 0.75);
    // The near plane through the centre, around the eye: a disc of radius 3 at distance 1.
    EXPECT_NEAR(bounds({0, 0, -1}, 3, 1).most, 3, 1e-15);
    // It touches the near plane from behind: nothing; from the front: all.
    EXPECT_EQ(bounds({0, 0, 2}, 3, 1).kind, maths::kSphereNothing);
    EXPECT_NEAR(bounds({0, 0, -5}, 3, 2).most, 0.75, 1e-15);
    // The surface through the eye: open to both sides without a near plane.
    EXPECT_EQ(bounds({0, 0, -3}, 3, 0).kind,
              maths::kSphereSeen | maths::kSphereOpenAbove | maths::kSphereOpenBelow);
    // Beside the eye and in its plane: open to that side only.
    EXPECT_EQ(bounds({5, 0, 0}, 3, 0).kind, maths::kSphereSeen | maths::kSphereOpenAbove);
    EXPECT_NEAR(bounds({5, 0, 0}, 3, 0).least, 4.0 / 3, 1e-15);
    EXPECT_EQ(bounds({-5, 0, 0}, 3, 0).kind, maths::kSphereSeen | maths::kSphereOpenBelow);
}

TEST(SphereBounds, BoxAndPolygonHoldEveryPlace) {
    test::Random random(3);
    for (int i = 0; i < 300; ++i) {
        const double near = random.uniform(0, 1) < 0.3 ? 0 : random.uniform(0.01, 1);
        const Frame3 frame = anyFrame(random);
        const Sphere sphere = anySphere(random, frame, near);
        const maths::BoxBounds box =
            maths::sphereBoxBounds(sphere.centre, sphere.radius, frame.right, frame.down, frame.ahead, near);
        for (int k = 0; k < 300; ++k) {
            const glm::dvec3 p = sphere.centre + sphere.radius * random.direction() * random.uniform(0.9, 1);
            const double z = glm::dot(frame.ahead, p);
            if (z <= near) continue;
            const glm::dvec2 place(glm::dot(frame.right, p) / z, glm::dot(frame.down, p) / z);
            ASSERT_NE(box.kind, maths::kSphereNothing);
            ASSERT_TRUE(glm::all(glm::greaterThanEqual(place, box.least)));
            ASSERT_TRUE(glm::all(glm::lessThanEqual(place, box.most)));
            const double turn = 2 * kPi * k / 300;
            const glm::dvec2 side(std::cos(turn), std::sin(turn));
            ASSERT_LE(glm::dot(side, place),
                      maths::sphereSideBound(sphere.centre, sphere.radius, side, frame.right, frame.down,
                                             frame.ahead, near));
        }
    }
}

// A sphere that is nowhere cut shows an ellipse, which a polygon of many sides is hardly larger than.
TEST(SphereBounds, PolygonOfManySidesIsTheEllipse) {
    constexpr int kSides = 128;
    test::Random random(4);
    for (int i = 0; i < 200; ++i) {
        const Frame3 frame = anyFrame(random);
        const double offAxis = random.uniform(0, 1), half = random.uniform(0.05, 1.4 - offAxis);
        const double distance = random.uniform(1, 9), turn = random.uniform(0, 2 * kPi);
        const glm::dvec3 centre =
            distance * (std::cos(offAxis) * frame.ahead +
                        std::sin(offAxis) * (std::cos(turn) * frame.right + std::sin(turn) * frame.down));
        std::vector<glm::dvec3> lines;  // (side, -bound): zero on the line
        for (int k = 0; k < kSides; ++k) {
            const glm::dvec2 side(std::cos(2 * kPi * k / kSides), std::sin(2 * kPi * k / kSides));
            lines.emplace_back(side, -maths::sphereSideBound(centre, distance * std::sin(half), side,
                                                             frame.right, frame.down, frame.ahead, 0));
        }
        std::vector<glm::dvec2> corners;
        for (size_t k = 0; k < kSides; ++k) {
            const glm::dvec3 corner = glm::cross(lines[k], lines[(k + 1) % kSides]);
            corners.push_back(glm::dvec2(corner) / corner.z);
        }
        double area = 0;
        for (size_t k = 0; k < kSides; ++k) {
            const glm::dvec2 a = corners[k], b = corners[(k + 1) % kSides];
            area += (a.x * b.y - a.y * b.x) / 2;
        }
        // Where a cone of this half angle, this far off the axis, meets the plane at distance one.
        const double squared = std::cos(offAxis + half) * std::cos(offAxis - half);
        const double ellipse =
            kPi * std::sin(half) * std::cos(half) / squared * std::sin(half) / std::sqrt(squared);
        EXPECT_GE(area, ellipse * (1 - 1e-9));
        EXPECT_LE(area, ellipse * (half + offAxis < 1.2 ? 1.01 : 1.2)) << half << ' ' << offAxis;
    }
}

class SphereBoundsShader : public test::GpuFormulas {
protected:
    SphereBoundsShader() : GpuFormulas({"sphere_bounds"}) {}
};

// Right, down and ahead are columns 0 to 2 of this rotation, the same in both languages to a float's last
// digit.
const std::string kFrame =
    "const vec3 right = vec3(0.8, 0.0, 0.6), down = vec3(0.36, 0.8, -0.48), ahead = vec3(-0.48, 0.6, 0.64);";
const glm::dvec3 kRight(0.8, 0, 0.6), kDown(0.36, 0.8, -0.48), kAhead(-0.48, 0.6, 0.64);

glm::vec4 sphereWithin(test::Random& random) {
    const glm::dvec3 centre = random.direction() * std::exp(random.uniform(-2, 5));
    const double radius = random.uniform(0, 1) < 0.2 ? glm::length(centre) * random.uniform(0.99, 1.01)
                                                     : std::exp(random.uniform(-5, 3));
    return {glm::vec3(centre), static_cast<float>(radius)};
}

TEST_F(SphereBoundsShader, AgreesWithDouble) {
    for (const double near : {0.0, 0.5}) {
        SCOPED_TRACE(near);
        EXPECT_LT(difference(
                      kFrame + "BoxBounds b = sphereBoxBounds(v.xyz, v.w, right, down, ahead, " +
                          std::to_string(near) +
                          "); return vec4(atan(b.least.x), atan(b.most.x), atan(b.least.y), atan(b.most.y));",
                      [&](glm::dvec4 v) {
                          const maths::BoxBounds b =
                              maths::sphereBoxBounds(v, v.w, kRight, kDown, kAhead, near);
                          return glm::dvec4(std::atan(b.least.x), std::atan(b.most.x), std::atan(b.least.y),
                                            std::atan(b.most.y));
                      },
                      [](test::Random& random) {
                          // Where roundings are not magnified: away from the surface and from the near plane.
                          for (;;) {
                              const glm::vec4 v = sphereWithin(random);
                              const float distance = glm::length(glm::vec3(v));
                              const double z = glm::dot(kAhead, glm::dvec3(v));
                              const bool touches = std::abs(z + v.w) < 0.02 * (distance + v.w) ||
                                                   std::abs(z + v.w - 0.5) < 0.02 * (distance + v.w);
                              if (std::abs(distance - v.w) > 0.05f * v.w && !touches) return v;
                          }
                      }),
                  2e-4);
    }
}

TEST_F(SphereBoundsShader, HoldsTheExactSphereWhenRoundedOut) {
    for (const double near : {0.0, 0.5}) {
        const Results results = run(
            kFrame +
                "BoxBounds b = sphereBoxBounds(v.xyz, sphereRoundedOut(v.xyz, v.w), right, down, ahead, " +
                std::to_string(near) +
                "); return b.kind == 0 ? vec4(1.0, -1.0, 1.0, -1.0) : vec4(b.least, b.most).xzyw;",
            sphereWithin);
        int loose = 0;
        for (size_t i = 0; i < results.given.size(); ++i) {
            const glm::dvec4 v(results.given[i]), found(results.found[i]);
            const maths::BoxBounds exact = maths::sphereBoxBounds(v, v.w, kRight, kDown, kAhead, near);
            if (exact.kind == maths::kSphereNothing) continue;
            // By less than atan in double rounds; an open side has the same bound in both, but for a float's
            // digits.
            const auto angle = [](double place) {
                return std::abs(place) > 1e29 ? std::copysign(kPi / 2, place) : std::atan(place);
            };
            ASSERT_LE(angle(found.x), angle(exact.least.x)) << i;
            ASSERT_GE(angle(found.y), angle(exact.most.x)) << i;
            ASSERT_LE(angle(found.z), angle(exact.least.y)) << i;
            ASSERT_GE(angle(found.w), angle(exact.most.y)) << i;
            loose += angle(found.y) - angle(exact.most.x) > 1e-4;
        }
        EXPECT_LT(loose, static_cast<int>(results.given.size() / 20)) << near;
    }
}

}  // namespace
}  // namespace curvewall
