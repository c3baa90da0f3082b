#include "server/frame_maker.h"

#include <nlohmann/json.hpp>

#include <algorithm>
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

SceneCache::SceneCache(size_t capacity, Load load) : capacity_(capacity), load_(std::move(load)) {}

ScenePtr SceneCache::get(const std::string& name) {
    const auto found = std::find_if(scenes_.begin(), scenes_.end(),
                                    [&name](const auto& entry) { return entry.first == name; });
    if (found != scenes_.end()) {
        scenes_.splice(scenes_.begin(), scenes_, found);
        return found->second;
    }
    // Makes room first, so that no more scenes than the capacity are ever in memory.
    if (scenes_.size() >= capacity_) scenes_.pop_back();
    auto scene = std::make_shared<const Scene>(load_(name));
    scenes_.emplace_front(name, scene);
    return scene;
}

RenderFunction makeFrameMaker(size_t maxLoadedScenes) {
    auto maker = std::make_shared<FrameMaker>(maxLoadedScenes);
    return [maker](const RenderCall& call) { return maker->make(call); };
}

}  // namespace curvewall
