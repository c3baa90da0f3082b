#pragma once
// One render that a client asked for, on its way to the render thread and back.

#include "renderer/image_file.h"
#include "renderer/render.h"

#include <chrono>
#include <functional>
#include <string>

namespace curvewall {

using Milliseconds = std::chrono::duration<double, std::milli>;

struct RenderCall {
    std::string scene;         // as loadScene takes it; scenes are loaded on the render thread
    bool cameraGiven = false;  // otherwise the scene's own
    ImageFormat format = ImageFormat::png;
    RenderRequest request;  // all but the scene is filled in
};

struct RenderedImage {
    std::string bytes;
    ImageFormat format = ImageFormat::png;
    std::string statsJson;  // on one line
    Milliseconds queueTime{0};
    Milliseconds renderTime{0};
    Milliseconds encodeTime{0};
};

// Made, called and destroyed on the render thread, because a GL context belongs to one.
using RenderFunction = std::function<RenderedImage(const RenderCall&)>;
using MakeRenderFunction = std::function<RenderFunction()>;

}  // namespace curvewall
