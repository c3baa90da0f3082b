#pragma once
// What a speed report is to measure.

#include "report/settings.h"

#include <string>
#include <vector>

namespace curvewall {

// A display with a scene: of the request wall, display, eye, scene, camera, style and tolerance count.
struct View {
    RenderRequest request;
    std::string wallName, sceneName;  // as the user knows them
};

struct MeasurementPlan {
    std::vector<View> views;
    double tolerancePx = kDefaultTolerancePx;  // that the walls are to keep
    Extent extent = Extent::full;
    int rounds = 3;          // of timing, one after the other over all settings
    int frames = 3;          // of a round, as RenderRequest::frames
    std::string folder;      // that results go to
    std::string references;  // and the truth
};

}  // namespace curvewall
