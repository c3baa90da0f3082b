#pragma once
// glTF 2.0 scenes, as text or binary.

#include "renderer/scene/scene.h"

#include <string>

namespace curvewall {

// Throws InputError. What the file holds that is not drawn is listed in the scene's notes.
Scene readGltf(const std::string& path);

}  // namespace curvewall
