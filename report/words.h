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
std::string decibelText(double db);     // "39.8", "equal" where it is infinite
std::string timesText(double ratio);    // "3.1 times as long", "about as long"

// "`image-based` (cube, linear) with faces of 2,048 px"
std::string settingText(const SettingName& setting);

}  // namespace curvewall
