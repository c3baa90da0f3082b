#include "calibration/projections/pose.h"

#include <glm/matrix.hpp>

#include <cmath>

namespace curvewall {

glm::dmat3 rotationFromOrientation(const Orientation& o) {
    const double cy = std::cos(o.yawRad), sy = std::sin(o.yawRad);
    const double cp = std::cos(o.pitchRad), sp = std::sin(o.pitchRad);
    const double cr = std::cos(o.rollRad), sr = std::sin(o.rollRad);
    // GLM constructs by columns.
    const glm::dmat3 yaw(cy, 0, sy, 0, 1, 0, -sy, 0, cy);
    const glm::dmat3 pitch(1, 0, 0, 0, cp, sp, 0, -sp, cp);
    const glm::dmat3 roll(cr, -sr, 0, sr, cr, 0, 0, 0, 1);
    return yaw * pitch * roll;
}

Orientation orientationFromRotation(const glm::dmat3& worldFromView) {
    const glm::dvec3 ahead = -worldFromView[2];
    Orientation o{std::atan2(ahead.x, -ahead.z), std::atan2(ahead.y, std::hypot(ahead.x, ahead.z)), 0};
    const glm::dvec3 up = glm::transpose(rotationFromOrientation(o)) * worldFromView[1];
    o.rollRad = std::atan2(up.x, up.y);
    return o;
}

}  // namespace curvewall
