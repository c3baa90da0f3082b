#include "calibration/pieces/pixel_rays.h"

#include <algorithm>

namespace curvewall {

// What one pixel along the axis changes of the direction, `centre` at `px`; zero where no neighbour has a
// ray.
glm::dvec3 PixelRays::directionStep(glm::ivec2 px, const glm::dvec3& centre, int axis) const {
    glm::dvec3 ends[2]{centre, centre};
    int steps = 0;
    for (const int side : {0, 1}) {
        glm::ivec2 beside = px;
        beside[axis] += 2 * side - 1;
        if (beside[axis] < 0 || beside[axis] >= sizePx_[axis]) continue;
        const glm::dvec3 ray = at(beside);
        if (!isRay(ray)) continue;
        ends[side] = glm::normalize(ray);
        ++steps;
    }
    return (ends[1] - ends[0]) / std::max(1.0, static_cast<double>(steps));
}

std::optional<glm::dvec2> PixelRays::offsetPx(glm::ivec2 px, glm::dvec3 ray) const {
    constexpr double kParallel = 1e-12;
    const glm::dvec3 centre = glm::normalize(at(px));
    const glm::dvec3 alongX = directionStep(px, centre, 0), alongY = directionStep(px, centre, 1);
    const double xx = glm::dot(alongX, alongX), yy = glm::dot(alongY, alongY), xy = glm::dot(alongX, alongY);
    const double det = xx * yy - xy * xy;
    if (!(det > kParallel * xx * yy)) return std::nullopt;
    if (!(glm::dot(ray, centre) > 0)) return glm::dvec2(std::numeric_limits<double>::infinity());
    const glm::dvec3 off = glm::normalize(ray) - centre;
    const double x = glm::dot(alongX, off), y = glm::dot(alongY, off);
    return glm::dvec2(yy * x - xy * y, xx * y - xy * x) / det;
}

}  // namespace curvewall
