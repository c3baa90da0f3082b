#pragma once
// Numbers and settings as a report's sentences and tables have them.

#include "report/speed_report.h"

#include <cstdint>
#include <string>

namespace curvewall {

std::string countText(uint64_t count);  // "1,673"

// Three digits that count, whole numbers from 1,000 on: "0.248", "62.1", "1,240".
std::string measureText(double value);

std::string percentText(double share);  // "0.42"; of 1
std::string decibelText(double db);     // "39.8", "∞" of equal pictures
std::string timesText(double ratio);    // "3.1 times as long", "about as long"

// "`image-based` (cube, linear) with faces of 2,048 px"
std::string settingText(const SettingName& setting);

std::string viewName(const ViewReport& view);  // "`dome-master`, `dome`, with `city`"
std::string pixelsText(double px);             // "0.25 px"

}  // namespace curvewall
