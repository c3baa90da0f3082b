#pragma once
// The --camera option.

#include "renderer/camera.h"

#include <string>

namespace curvewall {

// "x,y,z[,yaw,pitch,roll]", metres and degrees. Throws UsageError.
Camera cameraFromText(const std::string& text);

}  // namespace curvewall
