#pragma once
// The built-in scene `room`: a closed box, the plainest scene in which every ray hits something.

#include "renderer/scene/scene.h"

namespace curvewall {

inline constexpr glm::vec3 kRoomSizeM{8, 5, 8};

// Centred on the scene's origin, six walls of different colours, normals inward.
Scene makeRoom();

}  // namespace curvewall
