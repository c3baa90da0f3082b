#pragma once
// A city without textures, in which an error of the geometry is all that can be wrong at a pixel's centre.

#include "renderer/scene/scene.h"

namespace curvewall {

// Every texture becomes its average colour.
ScenePtr makeFlatCity();

}  // namespace curvewall
