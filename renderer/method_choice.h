#pragma once
// Which method draws a display fastest at the error that is asked for, told before anything is drawn.

#include "renderer/render.h"

#include <optional>
#include <string>
#include <vector>

namespace curvewall {

// How much there is to do in a frame; what it takes is a sum over these.
struct FrameAmounts {
    double seenTriangles = 0;   // looked at
    double drawnTriangles = 0;  // by the rasterizer
    double fragments = 0;
    double resampledPx = 0;
};

struct MethodForecast {
    RenderRequest request;  // of that method, with its knobs
    double errorPx = 0;     // the largest geometric error
    FrameAmounts amounts{};
    double frameMs = 0;               // in software, on two cores: what counts is which is less
    std::optional<double> trialMs{};  // what a frame took, where it was tried
};

struct MethodChoice {
    std::vector<MethodForecast> forecasts;  // of those that meet the tolerance, fastest first; never empty
    std::vector<std::string> ruledOut;      // "METHOD: why it does not"
};

// Of a request for Method::automatic with pieces fitted to its display at its tolerance. The reference is no
// candidate: it is what the others are judged by.
MethodChoice forecastMethods(const RenderRequest& request, const Display& display);

// In words, the method and those of its knobs that a forecast turns: "image-based, faces of 512 px".
std::string settingsOf(const RenderRequest& request);

}  // namespace curvewall
