#pragma once
// Orientation as installations write it: yaw turns right, pitch up, roll clockwise as the viewer sees it
// (SGCT and MPCDI). Right-handed, y up, forward is -z.

#include <glm/mat3x3.hpp>

namespace curvewall {

struct Orientation {
    double yawRad = 0;
    double pitchRad = 0;
    double rollRad = 0;

    bool operator==(const Orientation&) const = default;
};

// World from view: Ry(-yaw) Rx(pitch) Rz(-roll).
glm::dmat3 rotationFromOrientation(const Orientation& orientation);

}  // namespace curvewall
