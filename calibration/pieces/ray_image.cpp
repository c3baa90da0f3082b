#include "calibration/pieces/ray_image.h"

#include "calibration/parallel.h"
#include "calibration/pieces/fit_stop.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace curvewall {

RayImage::RayImage(const Projection& projection, glm::ivec2 sizePx, const std::stop_token& stop)
    : sizePx_(sizePx), rays_(static_cast<size_t>(sizePx.x) * static_cast<size_t>(sizePx.y)) {
    const PixelRays rays(projection, sizePx);
    parallelRanges(sizePx.y, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            throwIfStopped(stop);
            for (int x = 0; x < sizePx.x; ++x) rays_[indexOf({x, y})] = rays.at({x, y});
        }
    });
}

// What one pixel along the axis changes of the direction; zero where no neighbour has a ray.
glm::dvec3 RayImage::directionStep(glm::ivec2 px, int axis) const {
    glm::ivec2 before = px, after = px;
    if (px[axis] > 0) --before[axis];
    if (px[axis] + 1 < sizePx_[axis]) ++after[axis];
    if (!has(before)) before = px;
    if (!has(after)) after = px;
    const glm::dvec3 change = glm::normalize(at(after)) - glm::normalize(at(before));
    return change / std::max(1.0, static_cast<double>(after[axis] - before[axis]));
}

std::optional<glm::dvec2> RayImage::offsetPx(glm::ivec2 px, glm::dvec3 ray) const {
    constexpr double kParallel = 1e-12;
    const glm::dvec3 alongX = directionStep(px, 0), alongY = directionStep(px, 1);
    const double xx = glm::dot(alongX, alongX), yy = glm::dot(alongY, alongY), xy = glm::dot(alongX, alongY);
    const double det = xx * yy - xy * xy;
    if (!(det > kParallel * xx * yy)) return std::nullopt;
    const glm::dvec3 centre = glm::normalize(at(px)), off = glm::normalize(ray) - centre;
    if (!(glm::dot(ray, centre) > 0)) return glm::dvec2(std::numeric_limits<double>::infinity());
    const double x = glm::dot(alongX, off), y = glm::dot(alongY, off);
    return glm::dvec2(yy * x - xy * y, xx * y - xy * x) / det;
}

}  // namespace curvewall
