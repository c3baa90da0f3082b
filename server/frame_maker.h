#pragma once
// What the render thread does for a call: load the scene, render, encode.

#include "renderer/scene/load_scene.h"
#include "server/render_call.h"

#include <cstddef>
#include <functional>
#include <list>
#include <string>
#include <utility>

namespace curvewall {

// The scenes used last. Use it from one thread.
class SceneCache {
public:
    using Load = std::function<Scene(const std::string&)>;

    explicit SceneCache(size_t capacity, Load load = loadScene);

    ScenePtr get(const std::string& name);

private:
    const size_t capacity_;
    const Load load_;
    std::list<std::pair<std::string, ScenePtr>> scenes_;  // the most recent first
};

// A render function with its own Renderer and SceneCache.
RenderFunction makeFrameMaker(size_t maxLoadedScenes);

}  // namespace curvewall
