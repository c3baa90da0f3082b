#include "report/step_clock.h"

namespace curvewall {

void StepClock::took(double ms) {
    sumMs_ += ms;
    ++taken_;
    --left_;
}

double StepClock::leftMs() const {
    const double oneMs = taken_ == 0 ? guessMs_ : sumMs_ / static_cast<double>(taken_);
    return static_cast<double>(left_) * oneMs;
}

}  // namespace curvewall
