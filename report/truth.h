#pragma once
// The exact pictures that methods are judged by, kept in files between runs.

#include "report/errors.h"
#include "report/speed_report.h"

#include <string>

namespace curvewall {

// Rays a pixel come in pairs of passes, each of its own random places, until the mean of all is quiet.
struct Supersampling {
    int raysAPass = 64;
    int mostPairs = 4;
    double quietDb = 60;  // PSNR of the noise that is left
};

struct KnownTruth {
    Truth pictures;
    TruthFacts facts;
};

// Of the request's wall, display, scene, camera and style. Noise is told by the two halves of the passes:
// what they differ by is four times, in power, what their mean is off.
KnownTruth traceTruth(const RenderRequest& request, const Supersampling& supersampling);

// Whether `folder` has it, if its files are whole: then keptTruth need not trace.
bool isTruthKept(const std::string& viewKey, const Supersampling& supersampling, const std::string& folder);

// Reads from `folder` what is there for the same content (`viewKey`, see keyOfView) and supersampling, or
// traces it and puts it there. Throws std::runtime_error where that cannot be written.
KnownTruth keptTruth(const RenderRequest& request, const std::string& viewKey,
                     const Supersampling& supersampling, const std::string& folder);

}  // namespace curvewall
