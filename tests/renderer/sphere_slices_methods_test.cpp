// Iu's planar slices of a hemisphere at equal angles (Fisheye Views, 2000), by every method: what a pixel
// shows must lie along the ray of the paper's formula.

#include "calibration/errors.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/sphere_slices_lens.h"
#include "tests/support/gl_fixture.h"
#include "tests/support/rendering.h"
#include "tests/support/test_projections.h"
#include "tests/support/test_scenes.h"
#include "tests/support/test_walls.h"

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

namespace curvewall {
namespace {

const glm::ivec2 kSizePx(180, 180);
constexpr double kFovRad = 2.6;

// Rows are planes through the x axis, psi from the horizon, and columns angles A within a plane.
glm::dvec3 rayOf(glm::dvec2 px) {
    const double psiRad = (0.5 - px.y / kSizePx.y) * kFovRad;
    const double aRad = test::kPi / 2 + (px.x / kSizePx.x - 0.5) * kFovRad;
    return {-std::cos(aRad), std::sin(aRad) * std::sin(psiRad), -std::sin(aRad) * std::cos(psiRad)};
}

Wall slicesWall() {
    const auto lens = std::make_shared<SphereSlicesLens>(kFovRad, kFovRad, kSizePx);
    return wallOf(std::make_shared<LensProjection>(lens, Orientation{}), kSizePx);
}

// How far what a pixel shows is off its ray, in the angle of a pixel across the slices; the worst pixel.
double mostOffPx(const Frame& points) {
    double most = 0;
    for (int y = 0; y < points.sizePx.y; ++y) {
        for (int x = 0; x < points.sizePx.x; ++x) {
            const float* p = points.at(x, y);
            const glm::dvec3 shown = glm::normalize(glm::dvec3(p[0], p[1], p[2]));
            const double offRad = glm::length(glm::cross(shown, rayOf(centreOf({x, y}))));
            if (!(glm::dot(shown, rayOf(centreOf({x, y}))) > 0))
                return std::numeric_limits<double>::infinity();
            most = std::max(most, offRad * kSizePx.x / kFovRad);
        }
    }
    return most;
}

struct MethodCase {
    std::string name;
    Method method;
    double mostPx;
};

void PrintTo(const MethodCase& tried, std::ostream* out) { *out << tried.name; }

class SphereSlices : public test::GlTest, public ::testing::WithParamInterface<MethodCase> {};

RenderRequest roomOnSlices(Method method) {
    RenderRequest request =
        test::requestFor(slicesWall(), boxRoom({8, 5, 8}), {{0.5, 0.3, 1}, {0.7, 0.2, 0.1}});
    request.method = method;
    request.output = OutputKind::position;
    request.tessellationPx = 4;
    return request;
}

TEST_P(SphereSlices, ShowWhatLiesAlongTheRaysOfThePaper) {
    const Frame points = Renderer().render(roomOnSlices(GetParam().method)).frame;
    EXPECT_LT(mostOffPx(points), GetParam().mostPx);
}

// The texels of image-based are as large as a pixel, and the nearest is shown.
INSTANTIATE_TEST_SUITE_P(Methods, SphereSlices,
                         ::testing::Values(MethodCase{"Piecewise", Method::piecewise, 0.26},
                                           MethodCase{"ImageBased", Method::imageBased, 0.75},
                                           MethodCase{"VertexWarp", Method::vertexWarp, 0.3},
                                           MethodCase{"Reference", Method::reference, 1e-3},
                                           MethodCase{"Automatic", Method::automatic, 0.75}),
                         [](const auto& test) { return test.param.name; });

// Its bounding lines are those of projections that are round about an axis.
TEST_F(SphereSlices, AreRefusedByBoundedRaycast) {
    try {
        Renderer().render(roomOnSlices(Method::boundedRaycast));
        FAIL() << "was drawn";
    } catch (const UsageError& error) {
        EXPECT_THAT(error.what(), ::testing::HasSubstr("draws round lenses seen from the lens"));
    }
}

}  // namespace
}  // namespace curvewall
