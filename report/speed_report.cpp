#include "report/speed_report.h"

#include <fmt/core.h>

namespace curvewall {

std::string SettingName::text() const {
    std::string text = curve();
    if (knob.empty()) return samples == 1 ? text : fmt::format("{}, {} samples", text, samples);
    if (knob == "samples") return fmt::format("{}, {:g} {}", text, value, value == 1 ? "sample" : "samples");
    return fmt::format("{}, {:g} px", text, value);
}

uint64_t coverageFaults(const SettingResult& result) {
    return result.errors.coverage.uncoveredPixels + result.errors.coverage.overdrawnPixels +
           result.room.uncoveredPixels + result.room.twiceCoveredPixels;
}

}  // namespace curvewall
