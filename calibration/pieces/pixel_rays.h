#pragma once
// The rays of a display's pixel centres: what the pieces are fitted to, certified against and compared with.

#include "calibration/projections/projection.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stop_token>
#include <vector>

namespace curvewall {

inline glm::dvec2 centreOf(glm::ivec2 px) { return glm::dvec2(px) + 0.5; }

// Each is computed when it is asked for, unless all are kept.
class PixelRays {
public:
    // The projection must outlive this.
    PixelRays(const Projection& projection, glm::ivec2 sizePx) : projection_(&projection), sizePx_(sizePx) {}

    glm::ivec2 sizePx() const { return sizePx_; }

    // Computes all of them now: 24 bytes a pixel, for what asks for most of them more than once. Throws
    // FitStopped soon after a stop is requested.
    void keep(const std::stop_token& stop);

    // As unproject gives it (its length may be a distance); NaN in holes.
    glm::dvec3 at(glm::ivec2 px) const {
        return kept_.empty() ? computed(px)
                             : kept_[static_cast<size_t>(px.y) * static_cast<size_t>(sizePx_.x) +
                                     static_cast<size_t>(px.x)];
    }
    bool has(glm::ivec2 px) const { return isRay(at(px)); }
    static bool isRay(const glm::dvec3& ray) { return !std::isnan(ray.x); }

    // How far from the centre of a pixel with a ray the display shows another ray, to first order; infinite
    // for one that points the other way, and nothing where the neighbours do not tell how the display goes
    // on.
    std::optional<glm::dvec2> offsetPx(glm::ivec2 px, glm::dvec3 ray) const;

private:
    glm::dvec3 computed(glm::ivec2 px) const {
        const auto ray = projection_->unproject(centreOf(px));
        if (ray)
            if (const double squared = glm::dot(*ray, *ray); std::isfinite(squared) && squared > 0)
                return *ray;
        return glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    }
    glm::dvec3 directionStep(glm::ivec2 px, const glm::dvec3& centre, int axis) const;

    const Projection* projection_;
    glm::ivec2 sizePx_;
    std::vector<glm::dvec3> kept_;  // row by row from the top, or none
};

}  // namespace curvewall
