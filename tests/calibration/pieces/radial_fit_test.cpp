#include "calibration/pieces/radial_fit.h"

#include "calibration/pieces/certificate.h"
#include "calibration/pieces/radial_map.h"
#include "calibration/pieces/radial_profile.h"
#include "calibration/projections/cylinder.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"
#include "tests/support/shipped_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace curvewall {
namespace {

constexpr glm::ivec2 kSizePx(700, 600);

LensProjection fisheye(RadialModel model, double fovRad, glm::ivec2 sizePx = kSizePx) {
    return LensProjection(circularLens({model}, fovRad, sizePx), {});
}

struct Model {
    RadialModel model;
    double fovRad;
};
const std::vector<Model> kModels{{RadialModel::equidistant, 3.1},
                                 {RadialModel::equidistant, 5.5},
                                 {RadialModel::stereographic, 4},
                                 {RadialModel::equisolid, 3.6},
                                 {RadialModel::orthographic, 2.9}};

TEST(RadialMap, PutsEveryRayOverItsPlace) {
    for (const auto& [model, fovRad] : kModels) {
        const LensProjection lens = fisheye(model, fovRad);
        const auto map = RadialMap::of(lens, kSizePx, 1e-6);
        ASSERT_TRUE(map);
        EXPECT_LT(glm::distance(map->centrePx(), 0.5 * glm::dvec2(kSizePx)), 1e-6);
        std::mt19937 random(3);
        std::uniform_real_distribution<double> x(0, kSizePx.x), y(0, kSizePx.y);
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec2 px(x(random), y(random));
            const auto ray = lens.unproject(px);
            const auto height = map->height(px);
            ASSERT_EQ(ray.has_value(), height.has_value());
            if (!ray) continue;
            const glm::dvec3 point = glm::normalize(map->pointAt(px, *height));
            EXPECT_LT(glm::distance(point, glm::normalize(*ray)), 1e-9) << px.x << ", " << px.y;
        }
    }
}

TEST(RadialMap, IsNothingForACylinder) {
    const Display display = test::shippedWall("full-cylinder").displays[0];
    EXPECT_FALSE(RadialMap::of(*display.projection, display.sizePx, 0.01));
}

TEST(RadialMap, IsNothingForALensWithTangentialDistortion) {
    const Display display = test::shippedWall("camera").displays[0];
    EXPECT_FALSE(RadialMap::of(*display.projection, display.sizePx, 0.01));
}

TEST(RadialProfile, CountsWhatTheThinnestCoveringOfAFisheyeHas) {
    // The bend of an equidistant fisheye in closed form, integrated by Simpson's rule: with x the angle from
    // the axis, N = 2 pi R / (x_max hexagon tolerance) integral sqrt(2 (1 - x cot x) (x - sin x cos x) / x).
    const double xMax = std::numbers::pi / 2, radiusPx = 1024, tolerancePx = 0.5;
    const auto f = [](double x) {
        if (x == 0) return 0.0;
        return std::sqrt(2 * (1 - x / std::tan(x)) * (x - std::sin(x) * std::cos(x)) / x);
    };
    double integral = 0;
    constexpr int kParts = 1000;
    for (int i = 0; i <= kParts; ++i)
        integral += f(xMax * i / kParts) * (i == 0 || i == kParts ? 1 : i % 2 ? 4 : 2) * xMax / (3 * kParts);
    const double hexagon = 6 * std::numbers::sqrt3;
    const double expected = 2 * std::numbers::pi * radiusPx / xMax * integral / (hexagon * tolerancePx);

    const glm::ivec2 sizePx(2048);
    const LensProjection lens = fisheye(RadialModel::equidistant, std::numbers::pi, sizePx);
    auto map = RadialMap::of(lens, sizePx, 1e-6);
    ASSERT_TRUE(map);
    auto profile = RadialProfile::of(*map, 1e-6);
    if (!profile) profile = RadialProfile::of(map->turnedOver(), 1e-6);
    ASSERT_TRUE(profile);
    EXPECT_NEAR(profile->facetCount(tolerancePx), expected, 0.01 * expected);
}

TEST(RadialFit, KeepsEveryPixelOfEveryModelWithinTheTolerance) {
    for (const auto& [model, fovRad] : kModels) {
        const LensProjection lens = fisheye(model, fovRad);
        const auto mesh = fitRadial(lens, kSizePx, 0.5);
        ASSERT_TRUE(mesh);
        const Certificate certificate = certifyPieces(lens, *mesh).certificate;
        EXPECT_LE(certificate.maxPx, 1.05 * 0.5);  // fitPieces asks again for what lies between the samples
        EXPECT_EQ(certificate.uncoveredPixels, 0);
    }
}

TEST(RadialFit, NeedsLittleMoreThanTheThinnestCovering) {
    const glm::ivec2 sizePx(1024);
    const LensProjection lens = fisheye(RadialModel::equidistant, std::numbers::pi, sizePx);
    for (double tolerancePx : {1.0, 0.5, 0.25}) {
        const auto mesh = fitRadial(lens, sizePx, tolerancePx);
        ASSERT_TRUE(mesh);
        const double thinnest = 155 / tolerancePx;  // half of that of 2048 px, see above
        EXPECT_LT(static_cast<double>(mesh->pieces.size()), 1.5 * thinnest) << tolerancePx;
    }
}

TEST(RadialFit, FollowsADisplayWhoseCentreIsElsewhere) {
    // A window of a fisheye, its centre near a corner.
    class Window : public Projection {
    public:
        explicit Window(const Projection& whole) : whole_(whole) {}
        std::optional<glm::dvec3> unproject(glm::dvec2 px) const override {
            return whole_.unproject(px + glm::dvec2(300, 250));
        }
        std::vector<glm::dvec2> project(glm::dvec3) const override { return {}; }
        ProjectionPtr seenFrom(glm::dvec3) const override { return nullptr; }

    private:
        const Projection& whole_;
    };
    const LensProjection lens = fisheye(RadialModel::equidistant, std::numbers::pi);
    const Window window(lens);
    const glm::ivec2 sizePx(250, 300);
    const auto mesh = fitRadial(window, sizePx, 0.25);
    ASSERT_TRUE(mesh);
    const Certificate certificate = certifyPieces(window, *mesh).certificate;
    EXPECT_LE(certificate.maxPx, 1.05 * 0.25);
    EXPECT_EQ(certificate.uncoveredPixels, 0);
}

TEST(RadialFit, EndsSoonWhenItIsStopped) {
    std::stop_source source;
    source.request_stop();
    const LensProjection lens = fisheye(RadialModel::equidistant, std::numbers::pi);
    EXPECT_ANY_THROW(fitRadial(lens, kSizePx, 0.5, source.get_token()));
}

}  // namespace
}  // namespace curvewall
