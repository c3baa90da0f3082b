#pragma once
// What was measured, told to somebody who wants to know which method to use.

#include "report/document.h"
#include "report/speed_report.h"

namespace curvewall {

Document speedDocument(const SpeedReport& report);

}  // namespace curvewall
