#include "renderer/planar_source.h"

#include "calibration/errors.h"
#include "renderer/request_limits.h"
#include "renderer/source_axes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace curvewall {
namespace {

// A picture of 170 degrees is 23 times as wide as one of 90.
constexpr double kWidestDeg = 85;  // from the axis

// What of the plane a display needs, and how finely.
struct Framing {
    FaceAxes axes;
    glm::dvec2 from{std::numeric_limits<double>::infinity()};
    glm::dvec2 to{-std::numeric_limits<double>::infinity()};
    double step = 0;

    glm::dvec2 extent() const { return to - from; }
    double texels() const { return extent().x * extent().y / (step * step); }
};

// Nothing where a ray is too far from the axis.
std::optional<Framing> framingOf(const PixelRays& rays, const std::vector<glm::ivec2>& pixels,
                                 const FaceAxes& axes) {
    static const double least = std::cos(glm::radians(kWidestDeg));
    const SourceFace plane{axes, glm::dvec2(0), 1, {}};
    Framing framing{axes};
    std::vector<double> steps;
    for (const glm::ivec2 px : pixels) {
        const glm::dvec3 ray = rays.at(px);
        if (!PixelRays::isRay(ray)) continue;
        if (glm::dot(ray, axes.ahead) < least * glm::length(ray)) return std::nullopt;
        framing.from = glm::min(framing.from, plane.place(ray));
        framing.to = glm::max(framing.to, plane.place(ray));
        const auto step = stepAt(rays, px, [&](glm::dvec3 neighbour) {
            return glm::dot(neighbour, axes.ahead) > 0 ? &axes : nullptr;
        });
        if (step) steps.push_back(*step);
    }
    framing.step = std::max(leastStep(std::move(steps)).value_or(1), 1e-9);
    return framing;
}

// Turns the axes for as long as that saves texels.
Framing withFewestTexels(const PixelRays& rays, const std::vector<glm::ivec2>& pixels, Framing best) {
    constexpr double kFirstTurnRad = 0.2, kLastTurnRad = 1e-4;
    for (double angleRad = kFirstTurnRad; angleRad > kLastTurnRad;) {
        bool better = false;
        for (const TurnAround around : {TurnAround::down, TurnAround::right, TurnAround::ahead}) {
            for (const double turn : {angleRad, -angleRad}) {
                const auto tried = framingOf(rays, pixels, turned(best.axes, around, turn));
                if (!tried || tried->texels() >= best.texels()) continue;
                best = *tried;
                better = true;
            }
        }
        if (!better) angleRad /= 2;
    }
    return best;
}

ImageSource sourceOf(const Framing& framing, int faceSizePx) {
    const glm::dvec2 extent = glm::max(framing.extent(), glm::dvec2(framing.step));
    const double longer = std::max(extent.x, extent.y);
    const int neededPx = static_cast<int>(std::min(std::ceil(longer / framing.step), 1.0 * kMostFacePx));
    const int sidePx = faceSizePx > 0 ? faceSizePx : std::min(neededPx + 2 * kApronPx, kMostFacePx);
    const double texel = longer / (sidePx - 2 * kApronPx);
    // Rounding must not add a row.
    const glm::ivec2 sizePx = glm::ivec2(glm::ceil(extent / texel - 1e-6)) + 2 * kApronPx;
    const glm::dvec2 middle = 0.5 * (framing.from + framing.to);
    return {sidePx, {{framing.axes, middle - 0.5 * texel * glm::dvec2(sizePx), texel, sizePx}}};
}

}  // namespace

ImageSource planarSource(const PixelRays& rays, int faceSizePx) {
    const std::vector<glm::ivec2> lattice = latticeOf(rays.sizePx(), {48, 48});
    const std::vector<glm::dvec3> directions = directionsOf(rays, lattice);
    if (directions.empty()) return {faceSizePx > 0 ? faceSizePx : kLeastFacePx, {}};
    const glm::dvec3 axis = axisOf(directions);
    const auto refuse = [] {
        return UsageError("a planar source holds what lies within " + std::to_string(int(kWidestDeg)) +
                          " degrees of its axis, and this display shows more; the cube source holds it");
    };
    constexpr double kShortest = 0.01;  // cos(85 degrees) is more
    if (glm::length(axis) < kShortest) throw refuse();
    const auto first = framingOf(rays, lattice, axesAround(axis, aside(axis)));
    if (!first) throw refuse();
    const Framing best = withFewestTexels(rays, lattice, *first);
    const auto whole = framingOf(rays, latticeOf(rays.sizePx(), rays.sizePx()), best.axes);
    if (!whole) throw refuse();
    return sourceOf(*whole, faceSizePx);
}

}  // namespace curvewall
