#pragma once
// The numerical stability suite: every family at every value by every method, against the reference.

#include "report/hard_cases/family.h"
#include "report/hard_cases/methods.h"
#include "report/hard_cases/results.h"

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace curvewall {

struct SuiteOptions {
    int sizePx = 512;  // of the larger side of displays
    // Where pictures go and what is finished is kept, so that it is not run again. Empty: nowhere.
    std::string folder{};
    std::vector<std::string> methods{};  // names among hardCaseMethods(); empty: all
};

struct SuiteProgress {
    std::string family;
    double value = 0;
    size_t finishedCases = 0, allCases = 0;  // of the suite, or of the family where only it is run
};
using OnSuiteProgress = std::function<void(const SuiteProgress&)>;

// Nothing where a stop was requested. Throws GlUnavailable, and std::runtime_error where a file cannot be
// written.
std::optional<FamilyResult> runFamily(Renderer& renderer, const HardCaseFamily& family,
                                      const SuiteOptions& options, const OnSuiteProgress& onProgress = {},
                                      const std::stop_token& stop = {});

// All families. What the folder has of a family is taken from there if it was run in the same way.
std::optional<std::vector<FamilyResult>> runHardCases(const SuiteOptions& options,
                                                      const OnSuiteProgress& onProgress = {},
                                                      const std::stop_token& stop = {});

}  // namespace curvewall
