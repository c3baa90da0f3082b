#pragma once
// Where methods are known to break: what is not here is fine, and tests see that both stays true.

#include "report/hard_cases/family.h"
#include "report/hard_cases/results.h"

#include <string>
#include <vector>

namespace curvewall {

struct KnownLimit {
    std::string family;
    std::string methods;  // how their names begin
    double from = 0;      // the first of the family's values at which any display up to 1024 px breaks
    std::string why;
    bool isSeenSmall = true;  // on displays of about 100 px too
};

const std::vector<KnownLimit>& knownLimits();

// The limit that explains why a method is broken there, if any.
const KnownLimit* knownLimitOf(const HardCaseFamily& family, const CaseResult& result);

}  // namespace curvewall
