#pragma once
// The numerical stability suite: families at every value by every method, against the reference.

#include "report/hard_cases/family.h"
#include "report/hard_cases/methods.h"
#include "report/hard_cases/results.h"
#include "report/progress.h"

#include <string>
#include <vector>

namespace curvewall {

struct SuiteOptions {
    int sizePx = 512;  // of the larger side of displays
    // Where pictures go and what is finished is kept, so that it is not run again. Empty: nowhere.
    std::string folder{};
    std::vector<std::string> methods{};  // names among hardCaseMethods(); empty: all
};

// Throws GlUnavailable, and std::runtime_error where a file cannot be written.
FamilyResult runFamily(Renderer& renderer, const HardCaseFamily& family, const SuiteOptions& options);

// Throws as runFamily does. What the folder has of a family is taken from there if it was run in the same
// way, on the same machine. Steps of the progress are cases.
std::vector<FamilyResult> runFamilies(const std::vector<HardCaseFamily>& families,
                                      const SuiteOptions& options, const OnProgress& onProgress);

}  // namespace curvewall
