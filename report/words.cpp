#include "report/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace curvewall {

std::string countText(uint64_t count) {
    std::string text = std::to_string(count);
    for (size_t place = text.size(); place > 3; place -= 3) text.insert(place - 3, ",");
    return text;
}

std::string measureText(double value) {
    constexpr double kLeast = 1e-5;  // that has a digit
    if (value < 0) return "-" + measureText(-value);
    if (!std::isfinite(value)) return fmt::format("{}", value);
    if (value < kLeast) return "0";
    if (value >= 999.5) return countText(static_cast<uint64_t>(std::llround(value)));
    const int decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(value))), 0, 5);
    std::string text = fmt::format("{:.{}f}", value, decimals);
    if (text.find('.') == std::string::npos) return text;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

std::string percentText(double share) { return measureText(100 * share); }

std::string decibelText(double db) { return std::isinf(db) ? "∞" : fmt::format("{:.1f}", db); }

std::string timesText(double ratio) {
    if (std::abs(ratio - 1) < 0.05) return "about as long";
    if (ratio < 1) return fmt::format("{:.2g} of the time", ratio);
    return fmt::format("{:.{}f} times as long", ratio, ratio < 9.95 ? 1 : 0);
}

std::string settingText(const SettingName& setting) {
    std::string text = "`" + setting.method + "`";
    if (!setting.variant.empty()) text += " (" + setting.variant + ")";
    const std::string value = measureText(setting.value);
    if (setting.knob == "tolerance_px") text += " at " + value + " px";
    if (setting.knob == "face_size_px") text += " with faces of " + value + " px";
    if (setting.knob == "tessellation_px") text += " with edges of " + value + " px";
    if (setting.samples > 1) text += fmt::format(", {} samples", setting.samples);
    return text;
}

std::string viewName(const ViewReport& view) {
    return fmt::format("`{}`, `{}`, with `{}`", view.wall, view.display, view.scene);
}

std::string pixelsText(double px) { return measureText(px) + " px"; }

}  // namespace curvewall
