#pragma once
// Measures views setting by setting, and leaves each number in a file, so that a run that was cut off goes on
// where it was.

#include "report/settings.h"
#include "report/truth.h"

#include <functional>
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

struct MeasurementProgress {
    size_t done = 0, all = 0;  // steps
    double leftMs = 0;         // as steps of the same kind took so far
    std::string doing;
};

// Throws as Renderer::render does, but for what a method refuses, which is a result.
SpeedReport measureSpeed(const MeasurementPlan& plan,
                         const std::function<void(const MeasurementProgress&)>& advance);

}  // namespace curvewall
