#pragma once
// Where methods are known to break. What is not here is fine; tests see that both stays true on small
// displays.

#include "report/hard_cases/family.h"
#include "report/hard_cases/results.h"

#include <string>
#include <vector>

namespace curvewall {

struct KnownLimit {
    std::string family;
    std::string methods;  // how their names begin
    double from = 0;      // the first of the family's values that breaks, at 100 px or at 500
    std::string why;
    bool isSeenSmall = true;  // on displays of about 100 px too
};

const std::vector<KnownLimit>& knownLimits();

// The limit that explains why a method is broken there, if any.
const KnownLimit* knownLimitOf(const HardCaseFamily& family, const CaseResult& result);

}  // namespace curvewall
