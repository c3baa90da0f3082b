#include "report/error_orders.h"

#include <glm/vec2.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string_view>

namespace curvewall {
namespace {

// Positions are floats: nothing is shown more exactly than this.
constexpr double kGeometricFloorPx = 0.002;
constexpr double kClearlyAbove = 0.1;  // of the floor
constexpr double kFewPixels = 1e-5;    // of all: what chance decides

struct KnobOrder {
    std::string_view knob;
    double order;
};
constexpr std::array kKnobOrders{KnobOrder{"tolerance_px", 1}, KnobOrder{"face_size_px", -1},
                                 KnobOrder{"tessellation_px", 2}};

std::optional<double> expectedOrder(const std::string& knob) {
    const auto found = std::ranges::find(kKnobOrders, knob, &KnobOrder::knob);
    if (found == kKnobOrders.end()) return std::nullopt;
    return found->order;
}

// Nothing where the error is at the floor.
using ErrorAbove = std::function<std::optional<double>(const SettingResult&)>;

struct NamedError {
    std::string name;
    ErrorAbove above;
};

std::optional<double> aboveGeometricFloor(double errorPx) {
    if (!(errorPx > kGeometricFloorPx)) return std::nullopt;
    return errorPx;
}

// Of pictures in flat colours: how textures are filtered has no order in any knob.
std::vector<NamedError> errorsOf(const ViewReport& view) {
    const auto edges = [&view](const SettingResult& result) -> std::optional<double> {
        if (!result.edges) return std::nullopt;
        const auto floor = std::ranges::find(view.floors, result.setting.samples, &SamplingFloor::samples);
        const double least = floor == view.floors.end() ? 0 : floor->edgesOff;
        const double above = result.edges->shareOff - least;
        if (!(above > std::max(kClearlyAbove * least, kFewPixels))) return std::nullopt;
        return above;
    };
    return {{"geometric, largest",
             [](const SettingResult& r) { return aboveGeometricFloor(r.errors.geometric.maxPx); }},
            {"geometric, 99 in 100",
             [](const SettingResult& r) { return aboveGeometricFloor(r.errors.geometric.p99Px); }},
            {"wrong edges", edges}};
}

// Of y over x, by least squares; the x are not all the same.
double slope(const std::vector<glm::dvec2>& points) {
    glm::dvec2 mean{0};
    for (const glm::dvec2 point : points) mean += point / static_cast<double>(points.size());
    double xx = 0, xy = 0;
    for (const glm::dvec2 point : points) {
        xx += (point.x - mean.x) * (point.x - mean.x);
        xy += (point.x - mean.x) * (point.y - mean.y);
    }
    return xy / xx;
}

bool haveWidth(const std::vector<glm::dvec2>& points) {
    return std::ranges::any_of(points, [&](glm::dvec2 point) { return point.x != points.front().x; });
}

}  // namespace

std::vector<ErrorOrder> errorOrders(const ViewReport& view) {
    std::vector<std::string> curves;
    for (const SettingResult& result : view.settings)
        if (std::ranges::find(curves, result.setting.curve()) == curves.end())
            curves.push_back(result.setting.curve());
    std::vector<ErrorOrder> orders;
    for (const std::string& curve : curves)
        for (const NamedError& error : errorsOf(view)) {
            std::vector<glm::dvec2> points;
            double expected = 0;
            for (const SettingResult& result : view.settings) {
                const SettingName& setting = result.setting;
                const std::optional<double> order = expectedOrder(setting.knob);
                if (setting.curve() != curve || !result.refusal.empty() || !order || !(setting.value > 0))
                    continue;
                expected = *order;
                if (const std::optional<double> above = error.above(result))
                    points.emplace_back(std::log(setting.value), std::log(*above));
            }
            if (points.size() >= 2 && haveWidth(points))
                orders.push_back(
                    {curve, error.name, slope(points), expected, static_cast<int>(points.size())});
        }
    return orders;
}

}  // namespace curvewall
