#include "report/sampling_floor.h"

#include "calibration/angles.h"
#include "calibration/pieces/pixel_rays.h"
#include "calibration/projections/planar.h"
#include "report/flat_scene.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace curvewall {
namespace {

constexpr int kMostWindowPx = 256;
constexpr double kMostHalfAngleRad = std::numbers::pi / 5;  // flat pictures grow denser towards their borders

// Where windows are, as shares of the display's width and height.
constexpr glm::dvec2 kPlaces[] = {{0.5, 0.5}, {0.25, 0.3}, {0.75, 0.3}, {0.3, 0.7}, {0.7, 0.7}};

// Of the pixel, across; the mean of its width and height as areas count.
double angleOfPixelRad(const Projection& projection, glm::dvec2 px) {
    const auto left = projection.unproject(px - glm::dvec2(0.5, 0)),
               right = projection.unproject(px + glm::dvec2(0.5, 0)),
               up = projection.unproject(px - glm::dvec2(0, 0.5)),
               down = projection.unproject(px + glm::dvec2(0, 0.5));
    if (!left || !right || !up || !down) return 0;
    return std::sqrt(angleBetween(*left, *right) * angleBetween(*up, *down));
}

// A wall of one window that looks along `ray`.
WallPtr windowAlong(const Wall& wall, glm::dvec3 ray, double pixelRad) {
    const double mostPx = 2 * std::tan(kMostHalfAngleRad) / pixelRad;
    const glm::ivec2 sizePx(std::clamp(static_cast<int>(mostPx), 1, kMostWindowPx));
    const glm::dvec3 ahead = glm::normalize(ray);
    const glm::dvec3 up = std::abs(ahead.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    const double half = 0.5 * sizePx.x * pixelRad;
    const glm::dvec3 right = half * glm::normalize(glm::cross(ahead, up));
    const glm::dvec3 above = half * glm::normalize(glm::cross(right, ahead));
    const glm::dvec3 centre = wall.eyeM + ahead;
    const PlanarScreen screen{centre - right - above, centre + right - above, centre - right + above};
    Wall window{wall.name, wall.eyeM, wall.background, {}, {}};
    window.displays.push_back(
        {"window", sizePx, "planar", std::make_shared<PlanarProjection>(screen, wall.eyeM, sizePx)});
    return std::make_shared<const Wall>(std::move(window));
}

double meanSquare(double psnrDb) { return std::pow(10, -psnrDb / 10); }
double decibel(double meanSquare) { return -10 * std::log10(meanSquare); }

double edgesShareOff(Renderer& renderer, RenderRequest request) {
    const Frame drawn = renderer.render(request).frame;
    request.method = Method::reference;
    return compareColor(drawn, renderer.render(request).frame).shareOff;
}

}  // namespace

std::vector<RenderRequest> flatWindows(const RenderRequest& view) {
    const Display& display = findDisplay(*view.wall, view.display);
    std::vector<RenderRequest> windows;
    for (const glm::dvec2 place : kPlaces) {
        const glm::dvec2 px = centreOf(glm::ivec2(place * glm::dvec2(display.sizePx)));
        const auto ray = display.projection->unproject(px);
        const double pixelRad = angleOfPixelRad(*display.projection, px);
        if (!ray || pixelRad == 0) continue;
        windows.push_back(view);
        windows.back().wall = windowAlong(*view.wall, *ray, pixelRad);
        windows.back().display.clear();
        windows.back().method = Method::piecewise;
        windows.back().pieces = nullptr;
    }
    return windows;
}

std::optional<SamplingFloor> samplingFloor(Renderer& renderer, const std::vector<RenderRequest>& windows,
                                           const std::vector<KnownTruth>& truths, const ScenePtr& flat,
                                           int samples) {
    SamplingFloor floor{samples, 0, 0, 0, 0};
    double pixels = 0, off = 0, edgesOff = 0, squares = 0, supersampledSquares = 0;
    for (size_t i = 0; i < windows.size(); ++i) {
        RenderRequest request = windows[i];
        request.samples = samples;
        const Frame drawn = renderer.render(request).frame;
        const Truth& truth = truths[i].pictures;
        const double count = static_cast<double>(drawn.sizePx.x) * drawn.sizePx.y;
        const ImageDifference image = compareColor(drawn, samples > 1 ? truth.supersampled : truth.color);
        pixels += count;
        off += count * image.shareOff;
        if (samples == 1) edgesOff += count * edgesShareOff(renderer, inFlatColors(windows[i], flat));
        squares += count * meanSquare(image.psnrDb);
        supersampledSquares += count * meanSquare(compareColor(drawn, truth.supersampled).psnrDb);
    }
    if (pixels == 0) return std::nullopt;
    floor.shareOff = off / pixels;
    floor.edgesOff = edgesOff / pixels;
    floor.psnrDb = decibel(squares / pixels);
    floor.supersampledPsnrDb = decibel(supersampledSquares / pixels);
    return floor;
}

}  // namespace curvewall
