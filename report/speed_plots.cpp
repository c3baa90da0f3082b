#include "report/speed_plots.h"

#include "report/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

namespace curvewall {
namespace {

constexpr size_t kMostCurves = 10;

using Measure = std::function<double(const SettingResult&)>;

double geometricPx(const SettingResult& result) { return result.errors.geometric.maxPx; }
// Below this all there is are the roundings of floats.
constexpr double kLeastShownPx = 0.001;
double shownGeometricPx(const SettingResult& result) { return std::max(geometricPx(result), kLeastShownPx); }
double wrongPercent(const SettingResult& result) { return 100 * result.errors.image.shareOff; }
// Of several samples a pixel there is no such number, and the curve has no such point.
double wrongEdgesPercent(const SettingResult& result) {
    return result.edges ? 100 * result.edges->shareOff : 0;
}
double supersampledDb(const SettingResult& result) { return result.errors.supersampledPsnrDb; }

// With its samples where these are not what is turned.
std::string curveOf(const SettingName& setting) {
    if (setting.samples == 1 || setting.knob == "samples") return setting.curve();
    return fmt::format("{}, {} samples", setting.curve(), setting.samples);
}

std::string pointLabel(const SettingResult& result, const Measure& measure, const std::string& unit) {
    return fmt::format("{}: {} ms, {} {}", result.setting.text(), measureText(result.frameMs.median),
                       measureText(measure(result)), unit);
}

std::vector<Curve> curvesOf(const ViewReport& view, const Measure& measure, const std::string& unit) {
    std::vector<Curve> curves;
    for (const SettingResult& result : view.settings) {
        if (!result.refusal.empty()) continue;
        const std::string name = curveOf(result.setting);
        auto curve = std::ranges::find(curves, name, &Curve::name);
        if (curve == curves.end()) curve = curves.insert(curves.end(), Curve{name, {}, true, {}});
        curve->points.emplace_back(result.frameMs.median, measure(result));
        curve->labels.push_back(pointLabel(result, measure, unit));
    }
    return curves;
}

// How many times as long as the fastest of at most its error the curve's best point takes.
double distanceFromFront(const Curve& curve, const std::vector<glm::dvec2>& front) {
    double least = std::numeric_limits<double>::infinity();
    for (const glm::dvec2 point : curve.points)
        for (const glm::dvec2 best : front)
            if (best.y <= point.y) {
                least = std::min(least, point.x / best.x);
                break;
            }
    return least;
}

std::string methodOf(const std::string& curve) { return curve.substr(0, curve.find(',')); }

std::vector<glm::dvec2> allPoints(const std::vector<Curve>& curves) {
    std::vector<glm::dvec2> points;
    for (const Curve& curve : curves) points.insert(points.end(), curve.points.begin(), curve.points.end());
    return points;
}

// The same in all plots of a view.
std::set<std::string> shownCurves(const ViewReport& view) {
    std::vector<Curve> curves = curvesOf(view, geometricPx, "px");
    const std::vector<glm::dvec2> front = paretoFront(allPoints(curves));
    std::ranges::stable_sort(curves, {}, [&](const Curve& c) { return distanceFromFront(c, front); });
    std::set<std::string> shown, methods;
    for (const Curve& curve : curves)
        if (methods.insert(methodOf(curve.name)).second) shown.insert(curve.name);
    for (const Curve& curve : curves)
        if (shown.size() < kMostCurves) shown.insert(curve.name);
    return shown;
}

std::vector<Level> floorLevels(const ViewReport& view,
                               const std::function<double(const SamplingFloor&)>& measure) {
    std::vector<Level> levels;
    for (const SamplingFloor& floor : view.floors)
        if (floor.samples == 1) levels.push_back({"floor of sampling", measure(floor)});
    return levels;
}

std::string viewTitle(const ViewReport& view) {
    return fmt::format("{}, {}, {}", view.wall, view.display, view.scene);
}

PlotFigure figureOf(const ViewReport& view, Plot plot, const Measure& measure, const std::string& unit) {
    plot.curves = curvesOf(view, measure, unit);
    std::vector<Curve> judged = plot.curves;
    std::erase_if(judged, [](const Curve& curve) { return methodOf(curve.name) == "reference"; });
    std::vector<glm::dvec2> points = allPoints(judged);
    // What a logarithmic axis cannot show must not be what shuts everything else out of the front.
    std::erase_if(points, [&](glm::dvec2 p) { return plot.logarithmicY ? !(p.y > 0) : !std::isfinite(p.y); });
    plot.front = paretoFront(points, plot.moreIsBetterY);
    const std::set<std::string> shown = shownCurves(view);
    std::erase_if(plot.curves, [&](const Curve& curve) { return !shown.contains(curve.name); });
    plot.title = viewTitle(view);
    plot.xLabel = "time of a frame, ms";
    return {plot, {}};
}

}  // namespace

std::vector<PlotFigure> speedPlots(const ViewReport& view, double tolerancePx, const std::string& stem) {
    Plot geometric;
    geometric.yLabel = "largest geometric error, px";
    geometric.levels = {{fmt::format("asked for: {} px", measureText(tolerancePx)), tolerancePx}};
    Plot wrong;
    wrong.yLabel = "wrong pixels, %";
    wrong.levels = floorLevels(view, [](const SamplingFloor& floor) { return 100 * floor.shareOff; });
    Plot edges;
    edges.yLabel = "wrong edges, %";
    edges.levels = floorLevels(view, [](const SamplingFloor& floor) { return 100 * floor.edgesOff; });
    Plot psnr;
    psnr.yLabel = fmt::format("PSNR against {} rays a pixel, dB", view.truth.supersamples);
    psnr.logarithmicY = false;
    psnr.moreIsBetterY = true;
    psnr.levels = floorLevels(view, [](const SamplingFloor& floor) { return floor.supersampledPsnrDb; });

    std::vector<PlotFigure> figures{figureOf(view, geometric, shownGeometricPx, "px"),
                                    figureOf(view, edges, wrongEdgesPercent, "% wrong"),
                                    figureOf(view, wrong, wrongPercent, "% wrong"),
                                    figureOf(view, psnr, supersampledDb, "dB")};
    figures[0].picture = {stem + "-geometric.png",
                          "Time against the largest geometric error. Less than 0.001 px is drawn as 0.001 "
                          "px. Lower left is better."};
    figures[1].picture = {stem + "-wrong-edges.png",
                          "Time against the share of wrong edges: what is shown at the wrong place, whatever "
                          "filters textures. Lower left is better."};
    figures[2].picture = {stem + "-wrong-pixels.png",
                          "Time against the share of wrong pixels. Lower left is better."};
    figures[3].picture = {
        stem + "-supersampled.png",
        "Time against likeness to the supersampled truth. Upper left is better; blur counts as likeness."};
    std::erase_if(figures, [](const PlotFigure& figure) { return figure.plot.front.empty(); });
    return figures;
}

}  // namespace curvewall
