#include "report/hard_cases/known_limits.h"

#include <algorithm>

namespace curvewall {

const std::vector<KnownLimit>& knownLimits() {
    static const std::vector<KnownLimit> limits{};
    return limits;
}

const KnownLimit* knownLimitOf(const HardCaseFamily& family, const CaseResult& result) {
    const auto placeOf = [&](double value) {
        return std::ranges::find(family.values, value) - family.values.begin();
    };
    const auto found = std::ranges::find_if(knownLimits(), [&](const KnownLimit& limit) {
        return limit.family == family.name && result.method.starts_with(limit.methods) &&
               placeOf(limit.from) <= placeOf(result.value);
    });
    return found == knownLimits().end() ? nullptr : &*found;
}

}  // namespace curvewall
