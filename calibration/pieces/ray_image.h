#pragma once
// The rays of all pixel centres of a display at once, for what looks at most of them more than once.

#include "calibration/pieces/pixel_rays.h"

#include <stop_token>
#include <vector>

namespace curvewall {

class RayImage {
public:
    // Throws FitStopped soon after a stop is requested.
    RayImage(const Projection& projection, glm::ivec2 sizePx, const std::stop_token& stop = {});

    glm::ivec2 sizePx() const { return sizePx_; }

    // As unproject gives it (its length may be a distance); NaN in holes.
    const glm::dvec3& at(glm::ivec2 px) const { return rays_[indexOf(px)]; }
    bool has(glm::ivec2 px) const { return isRay(at(px)); }

    size_t indexOf(glm::ivec2 px) const {
        return static_cast<size_t>(px.y) * static_cast<size_t>(sizePx_.x) + static_cast<size_t>(px.x);
    }

    // How far from a pixel's centre the display shows a ray, to first order; infinite for one that points the
    // other way, and nothing where the neighbours do not tell how the display goes on.
    std::optional<glm::dvec2> offsetPx(glm::ivec2 px, glm::dvec3 ray) const;

    // Row by row from the top.
    const std::vector<glm::dvec3>& all() const { return rays_; }
    static bool isRay(const glm::dvec3& ray) { return !std::isnan(ray.x); }

private:
    glm::dvec3 directionStep(glm::ivec2 px, int axis) const;

    glm::ivec2 sizePx_;
    std::vector<glm::dvec3> rays_;
};

}  // namespace curvewall
