#pragma once
// A scene without textures, in which an error of the geometry is all that can be wrong at a pixel's centre.

#include "renderer/scene/scene.h"

namespace curvewall {

// Every texture becomes its average colour; what it cuts out is filled.
ScenePtr flatScene(Scene scene);

}  // namespace curvewall
