#pragma once
// Scenes by name: a file or a built-in.

#include "renderer/scene/scene.h"

#include <string>

namespace curvewall {

// `name` is "room", "city[:triangles[:seed]]", or a path to a .gltf, .glb or .obj file. Throws InputError
// that names the file, the field and what was expected; throws UsageError for a malformed built-in name.
Scene loadScene(const std::string& name);

// True for the names of built-in scenes, with or without parameters.
bool isBuiltInScene(const std::string& name);

}  // namespace curvewall
