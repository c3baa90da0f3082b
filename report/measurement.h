#pragma once
// Measures views setting by setting, and leaves each number in a file, so that a run that was cut off goes on
// where it was.

#include "report/measurement_plan.h"
#include "report/progress.h"
#include "report/speed_report.h"

namespace curvewall {

// Throws as Renderer::render does, but for what a method refuses, which is a result; and GlUnavailable before
// anything is measured.
SpeedReport measureSpeed(const MeasurementPlan& plan, const OnProgress& onProgress);

}  // namespace curvewall
