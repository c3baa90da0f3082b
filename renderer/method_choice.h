#pragma once
// Which method draws a display fastest at the error that is asked for, told before anything is drawn.

#include "renderer/render.h"

#include <string>
#include <vector>

namespace curvewall {

struct FittedPieces;

struct MethodForecast {
    RenderRequest request;  // of that method, with its knobs
    double errorPx = 0;     // the largest geometric error
    double frameMs = 0;     // in software, on two cores: what counts is which is less
};

struct MethodChoice {
    std::vector<MethodForecast> forecasts;  // of those that meet the tolerance, fastest first; never empty
    std::vector<std::string> ruledOut;      // "METHOD: why it does not"
};

// Of a request for Method::automatic with pieces fitted to its display at its tolerance. The reference is no
// candidate: it is what the others are judged by.
MethodChoice forecastMethods(const RenderRequest& request, const Display& display);

}  // namespace curvewall
