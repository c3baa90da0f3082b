#include "server/frame_maker.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <memory>
#include <vector>

namespace curvewall {
namespace {

class FrameMaker {
public:
    explicit FrameMaker(size_t maxLoadedScenes) : renderer_(maxLoadedScenes), scenes_(maxLoadedScenes) {}

    RenderedImage make(const RenderCall& call) {
        using Clock = std::chrono::steady_clock;
        const Clock::time_point begun = Clock::now();
        RenderRequest request = call.request;
        request.scene = scenes_.get(call.scene);
        if (!call.cameraGiven) request.camera = request.scene->defaultCamera;
        const RenderResult result = renderer_.render(request);
        const Clock::time_point rendered = Clock::now();
        const std::vector<uint8_t> bytes = encodeFrame(result.frame, call.format, request.output);

        RenderedImage image;
        image.bytes.assign(bytes.begin(), bytes.end());
        image.format = call.format;
        image.statsJson = toJson(result.stats).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
        image.renderTime = rendered - begun;
        image.encodeTime = Clock::now() - rendered;
        return image;
    }

private:
    Renderer renderer_;
    SceneCache scenes_;
};

}  // namespace

SceneCache::SceneCache(size_t capacity, Load load) : load_(std::move(load)), scenes_(capacity) {}

ScenePtr SceneCache::get(const std::string& name) {
    return scenes_.get(name, [&] { return std::make_shared<const Scene>(load_(name)); });
}

RenderFunction makeFrameMaker(size_t maxLoadedScenes) {
    auto maker = std::make_shared<FrameMaker>(maxLoadedScenes);
    return [maker](const RenderCall& call) { return maker->make(call); };
}

}  // namespace curvewall
