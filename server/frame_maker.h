#pragma once
// What the render thread does for a call: load the scene, render, encode.

#include "renderer/recently_used.h"
#include "renderer/scene/load_scene.h"
#include "server/render_call.h"

#include <cstddef>
#include <functional>
#include <string>

namespace curvewall {

// The scenes used last. Use it from one thread.
class SceneCache {
public:
    using Load = std::function<Scene(const std::string&)>;

    explicit SceneCache(size_t capacity, Load load = loadScene);

    ScenePtr get(const std::string& name);

private:
    const Load load_;
    RecentlyUsed<std::string, const Scene> scenes_;
};

// A render function with its own Renderer and SceneCache.
RenderFunction makeFrameMaker(size_t maxLoadedScenes);

}  // namespace curvewall
