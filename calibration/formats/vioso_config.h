#pragma once
// VIOSOWarpBlend.ini: what the program that uses a VIOSO warp file is told of the view.

#include "calibration/files/file_bytes.h"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <optional>
#include <string>

namespace curvewall {

struct ViosoView {
    std::string channel;
    std::optional<glm::dvec3> directionDeg;  // pitch, yaw, roll
    std::optional<glm::dvec4> fovDeg;        // left, top, right, bottom, all positive
    std::optional<glm::dvec3> eye;           // in the units of the program
    std::optional<glm::dmat4> viosoFromHost;
    bool isAutomatic = false;  // bAutoView: direction and fields of view are not used
};

// The channel that uses this warp file and, of its warps, the one of that index. Nothing where there is none.
// Throws InputError for lists of numbers that are none.
std::optional<ViosoView> findViosoView(const FileBytes& ini, const std::string& warpFile, int index);

}  // namespace curvewall
