#include "calibration/projections/frustum.h"

#include "calibration/errors.h"

#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <numbers>
#include <string>

namespace curvewall {
namespace {

void requireArea(const char* low, double lowRad, const char* high, double highRad) {
    constexpr double kQuarterTurnRad = std::numbers::pi / 2;
    // Angles next to one another may have the same tangent.
    if (!(lowRad > -kQuarterTurnRad && lowRad < highRad && highRad < kQuarterTurnRad &&
          std::tan(lowRad) < std::tan(highRad)))
        throw UsageError(std::string("a frustum needs angles within 90 degrees and ") + low + " below " +
                         high + "; they are " + std::to_string(glm::degrees(lowRad)) + " and " +
                         std::to_string(glm::degrees(highRad)));
}

}  // namespace

FrustumProjection::FrustumProjection(const Frustum& frustum, glm::dvec2 sizePx) {
    requireArea("left", frustum.leftRad, "right", frustum.rightRad);
    requireArea("down", frustum.downRad, "up", frustum.upRad);
    const double left = std::tan(frustum.leftRad), right = std::tan(frustum.rightRad);
    const double down = std::tan(frustum.downRad), up = std::tan(frustum.upRad);
    const glm::dmat3 viewFromPixel(glm::dvec3((right - left) / sizePx.x, 0, 0),
                                   glm::dvec3(0, (down - up) / sizePx.y, 0), glm::dvec3(left, up, -1));
    rayFromPixel_ = rotationFromOrientation(frustum.orientation) * viewFromPixel;
    pixelFromRay_ = glm::inverse(rayFromPixel_);
}

std::optional<glm::dvec3> FrustumProjection::unproject(glm::dvec2 px) const {
    return rayFromPixel_ * glm::dvec3(px, 1);
}

std::vector<glm::dvec2> FrustumProjection::project(glm::dvec3 ray) const {
    const glm::dvec3 h = pixelFromRay_ * ray;
    if (!(h.z > 0)) return {};  // in the plane through the eye or behind it
    return {glm::dvec2(h) / h.z};
}

ProjectionPtr FrustumProjection::seenFrom(glm::dvec3 /*eyeM*/) const {
    return std::make_shared<FrustumProjection>(*this);
}

}  // namespace curvewall
