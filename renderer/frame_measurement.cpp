#include "renderer/frame_measurement.h"

#include "calibration/stopwatch.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <string>

namespace curvewall {
namespace {

Camera cameraOfFrame(const RenderRequest& request, int frame) {
    Camera camera = request.camera;
    camera.orientation.yawRad += 2 * std::numbers::pi * frame / request.frames;
    return camera;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

}  // namespace

void measureFrames(const RenderRequest& request, const FrameSteps& steps, RenderStats& stats) {
    std::vector<double> frameMs;
    std::map<std::string_view, std::vector<double>> stageMs;
    const auto takeStages = [&] { return steps.takeStages ? steps.takeStages() : std::vector<StageTime>{}; };
    // A driver compiles its last parts at the first draw; the reference has nothing to compile.
    if (request.frames > 1 && request.method != Method::reference) {
        steps.draw(cameraOfFrame(request, 0));
        takeStages();
    }
    for (int frame = 0; frame < request.frames; ++frame) {
        const Stopwatch drawing;
        steps.draw(cameraOfFrame(request, frame));
        frameMs.push_back(drawing.ms());
        for (const auto& [stage, ms] : takeStages()) stageMs[stage].push_back(ms);
        if (frame == 0) steps.readFirst();
    }
    for (const auto& [stage, ms] : stageMs) stats.stageMs.push_back({std::string(stage), median(ms)});
    stats.frameMsMedian = median(frameMs);
    const auto [least, most] = std::ranges::minmax(frameMs);
    stats.frameMsMin = least;
    stats.frameMsMax = most;
}

}  // namespace curvewall
