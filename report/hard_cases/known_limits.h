#pragma once
// Where methods are known to break, and how badly at most. What is not here is fine; tests see that all of it
// stays true.

#include "report/hard_cases/family.h"
#include "report/hard_cases/results.h"

#include <string>
#include <vector>

namespace curvewall {

struct KnownLimit {
    std::string family;
    std::string methods;  // how their names begin
    double from = 0;      // the first of the family's values that breaks, on displays of 100 px or of 512
    // From there on, on either: how far what a pixel shows is off at most, how far what 99 pixels in 100
    // show, and the share of pixels that have the commonest fault: open, wrong, misplaced, or too much.
    double maxPx = 0, p99Px = 0, faultyShare = 0;
    std::string why;
    bool isSeenSmall = true;  // on displays of 100 px too
};

const std::vector<KnownLimit>& knownLimits();

// The limit that explains why a method is broken there, if any: what is worse than the limit is not
// explained, nor is what failed.
const KnownLimit* knownLimitOf(const HardCaseFamily& family, const CaseResult& result);

}  // namespace curvewall
