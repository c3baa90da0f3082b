#pragma once
// How much longer steps take that are all of one kind.

#include <cstddef>

namespace curvewall {

// Only steps with something to do are expected: what is done already, or cannot be done, takes no time and
// tells nothing of the others.
class StepClock {
public:
    // `guessMs` is what a step is taken to last until one is over.
    explicit StepClock(double guessMs) : guessMs_(guessMs) {}

    void expect(size_t steps) { left_ += steps; }
    // One of them is over,
    void took(double ms);
    // or turned out to have nothing to do.
    void skipped() { --left_; }

    double leftMs() const;

private:
    double guessMs_;
    double sumMs_ = 0;
    size_t taken_ = 0, left_ = 0;
};

}  // namespace curvewall
