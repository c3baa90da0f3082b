#pragma once
// Where the wall stands in the scene: the pose of the wall's origin.

#include "calibration/projections/pose.h"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace curvewall {

struct Camera {
    glm::dvec3 positionM{0};  // of the wall's origin, in scene coordinates
    Orientation orientation;  // scene from wall

    bool operator==(const Camera&) const = default;
};

// The eye in scene coordinates.
inline glm::dvec3 eyeInScene(const Camera& camera, glm::dvec3 eyeInWallM) {
    return camera.positionM + rotationFromOrientation(camera.orientation) * eyeInWallM;
}

}  // namespace curvewall
