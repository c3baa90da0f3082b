#pragma once
// A scene without textures, in which an error of the geometry is all that can be wrong at a pixel's centre.

#include "renderer/render.h"

namespace curvewall {

// Every texture becomes its average colour; what it cuts out is filled.
ScenePtr flatScene(Scene scene);

// One frame of the request in such a scene, without light that varies over a surface.
RenderRequest inFlatColors(RenderRequest request, const ScenePtr& flat);

}  // namespace curvewall
