#include "calibration/projections/pose.h"

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

}  // namespace curvewall
