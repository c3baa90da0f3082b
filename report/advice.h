#pragma once
// Which method to use, in plain words.

#include "report/document.h"
#include "report/speed_report.h"

#include <vector>

namespace curvewall {

// For each view the fastest setting that keeps the tolerance, what it costs, what comes next, and what half
// the error would cost.
std::vector<Block> adviceOf(const SpeedReport& report);

}  // namespace curvewall
