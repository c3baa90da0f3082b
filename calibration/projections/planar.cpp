#include "calibration/projections/planar.h"

#include "calibration/errors.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace curvewall {

// In sides of the screen. Matrices in single precision, which draw it, show nothing sensible from nearer.
constexpr double kLeastEyeDistance = 1e-5;

PlanarProjection::PlanarProjection(const PlanarScreen& screen, glm::dvec3 eyeM, glm::ivec2 sizePx)
    : screen_(screen), sizePx_(sizePx) {
    const glm::dvec3 right = screen.lowerRightM - screen.lowerLeftM;
    const glm::dvec3 up = screen.upperLeftM - screen.lowerLeftM;
    const glm::dvec3 corner = screen.upperLeftM - eyeM;
    const double area = glm::length(glm::cross(right, up));
    if (!(area > 1e-12 * glm::length(right) * glm::length(up)))
        throw UsageError("a planar screen needs three corners that span an area");
    const double eyeDistance = std::abs(glm::dot(glm::cross(right, up), corner)) / area;
    if (!(eyeDistance > kLeastEyeDistance * (glm::length(right) + glm::length(up))))
        throw UsageError(
            "the eye lies in the plane of a planar screen, or nearer to it than 1/100,000 of its sides");
    rayFromPixel_ = {right / static_cast<double>(sizePx.x), -up / static_cast<double>(sizePx.y), corner};
    pixelFromRay_ = glm::inverse(rayFromPixel_);
}

std::optional<glm::dvec3> PlanarProjection::unproject(glm::dvec2 px) const {
    return rayFromPixel_ * glm::dvec3(px, 1.0);
}

std::vector<glm::dvec2> PlanarProjection::project(glm::dvec3 ray) const {
    const glm::dvec3 h = pixelFromRay_ * ray;
    if (!(h.z > 0)) return {};  // parallel to the screen or pointing away from it
    return {glm::dvec2(h) / h.z};
}

ProjectionPtr PlanarProjection::seenFrom(glm::dvec3 eyeM) const {
    return std::make_shared<PlanarProjection>(screen_, eyeM, sizePx_);
}

}  // namespace curvewall
