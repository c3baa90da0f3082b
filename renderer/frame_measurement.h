#pragma once
// Draws the frames of a request and measures them.

#include "renderer/gl/stage_timer.h"
#include "renderer/render.h"

#include <functional>
#include <vector>

namespace curvewall {

// How a method draws.
struct FrameSteps {
    std::function<void(const Camera&)> draw;               // finishes its frame
    std::function<void()> readFirst;                       // after frame 0, outside the time
    std::function<std::vector<StageTime>()> takeStages{};  // of the frame just drawn, where there are any
};

void measureFrames(const RenderRequest& request, const FrameSteps& steps, RenderStats& stats);

}  // namespace curvewall
