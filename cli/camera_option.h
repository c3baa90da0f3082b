#pragma once
// The --camera and --eye options.

#include "renderer/camera.h"

#include <string>

namespace curvewall {

// "x,y,z[,yaw,pitch,roll]", metres and degrees. Throws UsageError.
Camera cameraFromText(const std::string& text);

// "x,y,z", metres. Throws UsageError.
glm::dvec3 eyeFromText(const std::string& text);

}  // namespace curvewall
