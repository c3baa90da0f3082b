// The five projectors of configs/five-projector-dome.json with their masks: what one sees on the dome.

#include "tests/support/blend_sum.h"
#include "tests/support/random_numbers.h"
#include "tests/support/shipped_walls.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace curvewall {
namespace {

// The dome is lit from here up to the zenith, seen from its centre. Below, it ends where the pictures do.
constexpr double kRimDeg = -10;

double elevationDeg(glm::dvec3 ray) { return std::asin(glm::normalize(ray).y) * 180 / std::numbers::pi; }

class DomeBlend : public ::testing::Test {
protected:
    static void SetUpTestSuite() {
        wall_ = new Wall(test::shippedWall("five-projector-dome"));
        masks_ = new BlendMasks(makeBlendMasks(*wall_));
    }
    static void TearDownTestSuite() {
        delete std::exchange(masks_, nullptr);
        delete std::exchange(wall_, nullptr);
    }
    static test::BlendedLight lightOn(glm::dvec3 ray) { return test::blendedLight(*wall_, *masks_, ray); }

    // Every point of the dome has the same share.
    static glm::dvec3 anyDirection(test::Random& random) {
        const double y = random.uniform(std::sin(kRimDeg * std::numbers::pi / 180), 1);
        const double azimuth = random.uniform(0, 2 * std::numbers::pi), level = std::sqrt(1 - y * y);
        return {level * std::sin(azimuth), y, -level * std::cos(azimuth)};
    }

    static inline const Wall* wall_ = nullptr;
    static inline const BlendMasks* masks_ = nullptr;
};

TEST_F(DomeBlend, LightIsEvenEverywhere) {
    test::Random random(1);
    int shared = 0, crossings = 0;
    double worst = 0;
    constexpr int kDirections = 100'000;
    for (int i = 0; i < kDirections; ++i) {
        const test::BlendedLight sum = lightOn(anyDirection(random));
        worst = std::max(worst, std::abs(sum.light - 1));
        shared += sum.displays > 1;
        crossings += sum.bordersNear > 1;
    }
    EXPECT_LT(worst, 0.01);
    EXPECT_GT(shared, kDirections / 2);
    EXPECT_GT(crossings, 100);
    RecordProperty("worst", std::to_string(worst));
}

// All borders in steps of a quarter of a pixel, at several depths: crossings with other borders are among
// them.
TEST_F(DomeBlend, LightIsEvenAlongEveryBorder) {
    double worst = 0;
    int crossings = 0;
    const auto visit = [&](const Display& display, glm::dvec2 px) {
        const auto ray = display.projection->unproject(px);
        if (!ray || elevationDeg(*ray) < kRimDeg) return;
        const test::BlendedLight sum = lightOn(*ray);
        worst = std::max(worst, std::abs(sum.light - 1));
        crossings += sum.bordersNear > 1;
    };
    for (const Display& display : wall_->displays) {
        const glm::dvec2 size(display.sizePx);
        for (const double depthPx : {0.0, 0.3, 1.0, 3.0})
            for (int axis = 0; axis < 2; ++axis)
                for (double along = 0; along <= size[axis]; along += 0.25)
                    for (const double across : {depthPx, size[1 - axis] - depthPx})
                        visit(display, axis == 0 ? glm::dvec2(along, across) : glm::dvec2(across, along));
    }
    EXPECT_LT(worst, 0.01);
    EXPECT_GT(crossings, 1000);
    RecordProperty("worst", std::to_string(worst));
}

TEST_F(DomeBlend, TheLargestDeviationThatIsReportedLiesBelowTheRim) {
    const Display& display = wall_->displays[masks_->sum.display];
    const auto ray = display.projection->unproject(glm::dvec2(masks_->sum.pixel) + 0.5);
    EXPECT_LT(elevationDeg(*ray), kRimDeg);
    EXPECT_LT(masks_->sum.shareOff, 1e-5);
}

}  // namespace
}  // namespace curvewall
