#include "report/speed_plots.h"

#include "report/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <set>

namespace curvewall {
namespace {

constexpr size_t kMostCurves = 10;

// Nothing where there is no such number of a setting.
using Measure = std::function<std::optional<double>(const SettingResult&)>;

double geometricPx(const SettingResult& result) { return result.errors.geometric.maxPx; }
// Below this all there is are the roundings of floats.
constexpr double kLeastShownPx = 0.001;
double shownGeometricPx(const SettingResult& result) { return std::max(geometricPx(result), kLeastShownPx); }
double wrongPercent(const SettingResult& result) { return 100 * result.errors.image.shareOff; }
std::optional<double> wrongEdgesPercent(const SettingResult& result) {
    if (!result.edges) return std::nullopt;
    return 100 * result.edges->shareOff;
}
double supersampledDb(const SettingResult& result) { return result.errors.supersampledPsnrDb; }

// Time against one error.
struct ErrorPlot {
    Plot plot;  // but for what depends on the settings
    Measure measure;
    std::string unit;
    std::string name;  // in that of its file
    std::string caption;
    std::string wherePerfect{};  // what to say where no setting has such an error
};

// With its samples where these are not what is turned.
std::string curveOf(const SettingName& setting) {
    if (setting.samples == 1 || setting.knob == "samples") return setting.curve();
    return fmt::format("{}, {} samples", setting.curve(), setting.samples);
}

std::string pointLabel(const SettingResult& result, double error, const std::string& unit) {
    return fmt::format("{}: {} ms, {} {}", result.setting.text(), measureText(result.frameMs.median),
                       measureText(error), unit);
}

std::vector<Curve> curvesOf(const ViewReport& view, const Measure& measure, const std::string& unit) {
    std::vector<Curve> curves;
    for (const SettingResult& result : view.settings) {
        const std::optional<double> error = result.refusal.empty() ? measure(result) : std::nullopt;
        if (!error) continue;
        const std::string name = curveOf(result.setting);
        auto curve = std::ranges::find(curves, name, &Curve::name);
        if (curve == curves.end()) curve = curves.insert(curves.end(), Curve{name, {}, {}});
        curve->points.emplace_back(result.frameMs.median, *error);
        curve->labels.push_back(pointLabel(result, *error, unit));
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

// Of settings that the plot would show if its axes had a place for them.
std::string unseenSettings(const ViewReport& view, const ErrorPlot& error,
                           const std::set<std::string>& shown) {
    constexpr size_t kMostNamed = 4;
    std::string names;
    size_t count = 0;
    for (const SettingResult& result : view.settings) {
        if (!result.refusal.empty() || !shown.contains(curveOf(result.setting))) continue;
        const std::optional<double> y = error.measure(result);
        if (!y || isVisible(error.plot, {1, *y})) continue;
        if (++count <= kMostNamed) names += (count == 1 ? "" : "; ") + settingText(result.setting);
    }
    if (count == 0) return "";
    if (count > kMostNamed) names += fmt::format("; and {} more", count - kMostNamed);
    const char* const why = error.plot.logarithmicY ? "with an error of 0" : "equal to the truth";
    return fmt::format(" Not shown, {}: {}.", why, names);
}

std::string unseenLevels(const Plot& plot) {
    std::string text;
    for (const Level& level : plot.levels)
        if (!isVisible(plot, {1, level.y}))
            text += fmt::format(" No line shows the {}, which is {}.", level.name, measureText(level.y));
    return text;
}

bool showsAnything(const Plot& plot) {
    return std::ranges::any_of(allPoints(plot.curves), [&](glm::dvec2 p) { return isVisible(plot, p); });
}

PlotFigure figureOf(const ViewReport& view, const ErrorPlot& error, const std::string& stem) {
    Plot plot = error.plot;
    std::vector<Curve> judged = plot.curves;
    std::erase_if(judged, [](const Curve& curve) { return methodOf(curve.name) == "reference"; });
    std::vector<glm::dvec2> points = allPoints(judged);
    // What the axes cannot show must not be what shuts everything else out of the front.
    std::erase_if(points, [&](glm::dvec2 p) { return !isVisible(plot, p); });
    plot.front = paretoFront(points, plot.moreIsBetterY);
    const std::set<std::string> shown = shownCurves(view);
    std::erase_if(plot.curves, [&](const Curve& curve) { return !shown.contains(curve.name); });
    plot.title = fmt::format("{}, {}, {}", view.wall, view.display, view.scene);
    plot.xLabel = "time of a frame, ms";
    return {plot,
            {fmt::format("{}-{}.png", stem, error.name),
             error.caption + unseenSettings(view, error, shown) + unseenLevels(plot)}};
}

ErrorPlot geometricPlot(double tolerancePx) {
    ErrorPlot error{{},
                    shownGeometricPx,
                    "px",
                    "geometric",
                    "Time against the largest geometric error. Less than 0.001 px is drawn as 0.001 px. "
                    "Lower left is better."};
    error.plot.yLabel = "largest geometric error, px";
    error.plot.levels = {{fmt::format("asked for: {} px", measureText(tolerancePx)), tolerancePx}};
    return error;
}

ErrorPlot edgesPlot(const ViewReport& view) {
    ErrorPlot error{{},
                    wrongEdgesPercent,
                    "% wrong",
                    "wrong-edges",
                    "Time against the share of wrong edges: what is shown at the wrong place, whatever "
                    "filters textures. Lower left is better.",
                    "No setting has a wrong edge, so that there is no plot of them."};
    error.plot.yLabel = "wrong edges, %";
    error.plot.levels = floorLevels(view, [](const SamplingFloor& floor) { return 100 * floor.edgesOff; });
    return error;
}

ErrorPlot pixelsPlot(const ViewReport& view) {
    ErrorPlot error{{},
                    wrongPercent,
                    "% wrong",
                    "wrong-pixels",
                    "Time against the share of wrong pixels. Lower left is better.",
                    "No setting has a wrong pixel, so that there is no plot of them."};
    error.plot.yLabel = "wrong pixels, %";
    error.plot.levels = floorLevels(view, [](const SamplingFloor& floor) { return 100 * floor.shareOff; });
    return error;
}

ErrorPlot likenessPlot(const ViewReport& view) {
    ErrorPlot error{
        {},
        supersampledDb,
        "dB",
        "supersampled",
        "Time against likeness to the supersampled truth. Upper left is better; blur counts as likeness.",
        "Every setting equals the supersampled truth, so that there is no plot of likeness."};
    error.plot.yLabel = fmt::format("PSNR against {} rays a pixel, dB", view.truth.supersamples);
    error.plot.logarithmicY = false;
    error.plot.moreIsBetterY = true;
    error.plot.levels =
        floorLevels(view, [](const SamplingFloor& floor) { return floor.supersampledPsnrDb; });
    return error;
}

}  // namespace

std::vector<Block> speedPlots(const ViewReport& view, double tolerancePx, const std::string& stem) {
    std::vector<Block> figures, notes;
    for (ErrorPlot error :
         {geometricPlot(tolerancePx), edgesPlot(view), pixelsPlot(view), likenessPlot(view)}) {
        error.plot.curves = curvesOf(view, error.measure, error.unit);
        if (showsAnything(error.plot))
            figures.emplace_back(figureOf(view, error, stem));
        else if (!error.plot.curves.empty())
            notes.emplace_back(Paragraph{error.wherePerfect});
    }
    figures.insert(figures.end(), notes.begin(), notes.end());
    return figures;
}

}  // namespace curvewall
