#pragma once
// Orientation as installations write it: yaw turns right, pitch up, roll clockwise as the viewer sees it
// (SGCT and MPCDI). Right-handed, y up, forward is -z.

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace curvewall {

struct Orientation {
    double yawRad = 0;
    double pitchRad = 0;
    double rollRad = 0;

    bool operator==(const Orientation&) const = default;
};

// Where a display stands: wall from display is rotation and then center.
struct Pose {
    glm::dvec3 centerM{0};
    Orientation orientation;
};

// World from view: Ry(-yaw) Rx(pitch) Rz(-roll).
glm::dmat3 rotationFromOrientation(const Orientation& orientation);

// Its inverse, for a rotation.
Orientation orientationFromRotation(const glm::dmat3& worldFromView);

}  // namespace curvewall
