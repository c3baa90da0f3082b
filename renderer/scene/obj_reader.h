#pragma once
// Wavefront OBJ scenes with their MTL materials.

#include "renderer/scene/scene.h"

#include <string>

namespace curvewall {

// Surfaces are two-sided. Throws InputError. A missing MTL file or texture is not an error but a note.
Scene readObj(const std::string& path);

}  // namespace curvewall
