#pragma once
// What became of hard cases.

#include "report/errors.h"
#include "report/hard_cases/truth_check.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace curvewall {

enum class Outcome {
    drawn,
    refused,  // with a reason, before anything was drawn
    failed,   // in any other way
};

// One case by one method.
struct CaseResult {
    double value = 0;
    std::string method;
    Outcome outcome = Outcome::drawn;
    std::string reason{};  // of a refusal or failure
    // Of what was drawn.
    MethodErrors errors{};
    uint64_t wrongPixels = 0, gapPixels = 0;  // see wrong_pixels.h
    uint64_t displayPixels = 0;
    std::string fault{};  // what is beyond the method's bounds, in words; empty where nothing is

    bool isBroken() const { return outcome == Outcome::failed || !fault.empty(); }
    // Pixels that stay open, those that show more than there is, and the share of all that are at fault in
    // the way that most are.
    uint64_t openPixels() const { return std::max(gapPixels, errors.coverage.uncoveredPixels); }
    uint64_t addedPixels() const {
        return errors.coverage.overdrawnPixels + errors.coverage.twiceCoveredPixels;
    }
    double faultyShare() const;
};

// How far the reference can be trusted with one case.
struct CaseTruth {
    double value = 0;
    std::string refusal{};  // of the wall itself: nothing was drawn
    TruthCheck check{};
    double geometricPx = 0;  // of the reference's own points, at most
};

struct CasePicture {
    std::string file;  // relative to the suite's folder
    std::string caption;
};

struct FamilyResult {
    std::string family;
    int sizePx = 0;
    std::vector<CaseTruth> truths;    // by value
    std::vector<CaseResult> results;  // by value, then method
    std::vector<CasePicture> pictures;

    const CaseResult* find(double value, const std::string& method) const;
};

// A name as it is in names of files.
std::string stemOf(std::string name);

nlohmann::json toJson(const FamilyResult& result);
// Throws nlohmann::json::exception for anything that toJson does not write.
FamilyResult familyResultFromJson(const nlohmann::json& json);

}  // namespace curvewall
