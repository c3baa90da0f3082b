#pragma once
// What every measured frame has: a wall, and a scene seen from its own camera.

#include "renderer/render.h"

#include <utility>

namespace curvewall {

inline RenderRequest requestFor(WallPtr wall, ScenePtr scene, int frames = 1) {
    RenderRequest request;
    request.wall = std::move(wall);
    request.camera = scene->defaultCamera;
    request.scene = std::move(scene);
    request.frames = frames;
    return request;
}

}  // namespace curvewall
