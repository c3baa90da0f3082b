#pragma once
// A report as measuring makes them, but of figures that follow formulas: a dome and a cylinder, on which some
// methods cannot draw.

#include "report/speed_report.h"

namespace curvewall::test {

SpeedReport madeUpReport();

// One setting of `method`, so far off and so slow.
SettingResult madeUpSetting(const std::string& method, const std::string& variant, const std::string& knob,
                            double value, double errorPx, double frameMs);

}  // namespace curvewall::test
