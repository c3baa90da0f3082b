#pragma once
// Which setting to use on a display with a scene.

#include "report/speed_report.h"

#include <string>
#include <vector>

namespace curvewall {

// Settings are those of the view. The reference is none of them: it is what they are judged by. Nor are those
// of several samples, which buy something else with their time.
struct Recommendation {
    const SettingResult* best = nullptr;          // the fastest that keeps the tolerance, if any does
    std::vector<const SettingResult*> others{};   // of each other method its fastest that does, by time
    const SettingResult* halfError = nullptr;     // the fastest that keeps half the tolerance, if any does
    std::vector<const SettingResult*> missing{};  // of each method that does not, its most exact, by error
    std::vector<std::string> refusing{};          // methods that draw nothing here
};

Recommendation recommend(const ViewReport& view, double tolerancePx);

// Its largest geometric error is within, and hardly a pixel is misplaced, wrongly covered or no number.
bool keeps(const SettingResult& result, double tolerancePx, glm::ivec2 sizePx);

}  // namespace curvewall
