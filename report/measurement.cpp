#include "report/measurement.h"

#include "calibration/stopwatch.h"
#include "report/machine.h"
#include "report/step_clock.h"
#include "report/view_measurement.h"

#include <array>
#include <memory>
#include <utility>

namespace curvewall {
namespace {

// One for each kind of step.
class StepClocks {
public:
    explicit StepClocks(const std::vector<Step>& steps) {
        for (const Step& step : steps)
            if (!step.isKept) of(step.kind).expect(1);
    }
    StepClock& of(StepKind kind) { return clocks_[static_cast<size_t>(kind)]; }
    double leftMs() const {
        double sumMs = 0;
        for (const StepClock& clock : clocks_) sumMs += clock.leftMs();
        return sumMs;
    }

private:
    // In the order of StepKind.
    std::array<StepClock, 5> clocks_{StepClock(60'000), StepClock(10'000), StepClock(5'000), StepClock(2'000),
                                     StepClock(1'000)};
};

void takeAll(const std::vector<Step>& steps, const OnProgress& onProgress) {
    StepClocks clocks(steps);
    for (size_t i = 0; i < steps.size(); ++i) {
        const Step& step = steps[i];
        onProgress({i, steps.size(), clocks.leftMs(), step.doing});
        const Stopwatch watch;
        const bool hadWork = step.take();
        if (step.isKept) continue;
        if (hadWork)
            clocks.of(step.kind).took(watch.ms());
        else
            clocks.of(step.kind).skipped();
    }
}

}  // namespace

SpeedReport measureSpeed(const MeasurementPlan& plan, const OnProgress& onProgress) {
    const GlDriver driver = glDriver();
    SpeedReport report{driver.renderer, processorName(), plan.tolerancePx, {}};
    std::vector<std::unique_ptr<ViewMeasurement>> measurements;
    std::vector<Step> steps;  // of all views, one after the other
    for (const View& view : plan.views) {
        auto& measurement = measurements.emplace_back(std::make_unique<ViewMeasurement>(view, plan, driver));
        for (Step& step : measurement->steps()) steps.push_back(std::move(step));
        steps.push_back(
            {StepKind::pictures, "pictures", false, [&report, &measurements, at = measurements.size() - 1] {
                 report.views.push_back(measurements[at]->finish());
                 measurements[at].reset();  // and its pictures, pieces and context
                 return true;
             }});
    }
    takeAll(steps, onProgress);
    return report;
}

}  // namespace curvewall
