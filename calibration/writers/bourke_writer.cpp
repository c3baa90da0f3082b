#include "calibration/writers/bourke_writer.h"

#include "calibration/pieces/pixel_rays.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace curvewall {
namespace {

// Bilinear between the centres of pixels that see something: a mask says nothing of others.
double alphaAt(const Display& display, glm::dvec2 px) {
    if (!display.blend || display.blend->alpha.empty()) return 1;
    const glm::ivec2 last = display.sizePx - 1;
    const glm::dvec2 at = glm::clamp(px - 0.5, glm::dvec2(0), glm::dvec2(last));
    const glm::ivec2 low(at);
    const glm::dvec2 f = at - glm::dvec2(low);
    double sum = 0, weights = 0;
    for (const glm::ivec2 step : {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(1, 1)}) {
        const glm::ivec2 pixel = glm::min(low + step, last);
        const double weight = (step.x == 1 ? f.x : 1 - f.x) * (step.y == 1 ? f.y : 1 - f.y);
        if (weight == 0 || !display.projection->unproject(centreOf(pixel))) continue;
        const glm::dvec3 rgb =
            display.blend->alpha[static_cast<size_t>(pixel.y) * static_cast<size_t>(display.sizePx.x) +
                                 static_cast<size_t>(pixel.x)];
        sum += weight * (rgb.r + rgb.g + rgb.b) / 3;
        weights += weight;
    }
    return weights > 0 ? sum / weights : 1;
}

}  // namespace

FisheyeSource fisheyeSource(const RayGrid& grid, glm::ivec2 sizePx) {
    constexpr double kMargin = 1 + 1e-6;  // so that rounding leaves the outermost nodes inside
    const ViewCone cone = viewCone(grid);
    const double fovRad = std::clamp(2 * cone.halfAngleRad * kMargin, 1e-3, 2 * std::numbers::pi);
    return {std::max(sizePx.x, sizePx.y), fovRad, cone.orientation};
}

BourkeMesh bourkeMesh(const Display& display, const RayGrid& grid, const FisheyeSource& source) {
    const LensProjection fisheye(circularLens({}, source.fovRad, glm::ivec2(source.sidePx)),
                                 source.orientation);
    const double aspect = static_cast<double>(display.sizePx.x) / display.sizePx.y;
    BourkeMesh mesh{fmt::format("2\n{} {}\n", grid.nodes.x, grid.nodes.y)};
    for (int row = grid.nodes.y - 1; row >= 0; --row)
        for (int column = 0; column < grid.nodes.x; ++column) {
            const glm::dvec2 px = grid.positionPx({column, row}, display.sizePx);
            const glm::dvec3 ray = grid.rays[static_cast<size_t>(row) * static_cast<size_t>(grid.nodes.x) +
                                             static_cast<size_t>(column)];
            glm::dvec2 at(0);
            double intensity = -1;
            if (PixelRays::isRay(ray)) {
                at = glm::clamp(fisheye.project(ray).at(0) / static_cast<double>(source.sidePx), 0.0, 1.0);
                intensity = std::pow(alphaAt(display, px), 1 / kIntensityGamma);
                mesh.hasIntensity = mesh.hasIntensity || intensity != 1;
            }
            fmt::format_to(std::back_inserter(mesh.text), "{:.10g} {:.10g} {:.10g} {:.10g} {:.8g}\n",
                           aspect * (2 * px.x / display.sizePx.x - 1), 1 - 2 * px.y / display.sizePx.y, at.x,
                           1 - at.y, intensity);
        }
    return mesh;
}

}  // namespace curvewall
