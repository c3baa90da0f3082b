#pragma once
// The rays of a display's pixel centres, each computed when it is asked for: what the pieces are fitted to,
// certified against and compared with.

#include "calibration/projections/projection.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <limits>
#include <optional>

namespace curvewall {

inline glm::dvec2 centreOf(glm::ivec2 px) { return glm::dvec2(px) + 0.5; }

class PixelRays {
public:
    // The projection must outlive this.
    PixelRays(const Projection& projection, glm::ivec2 sizePx) : projection_(&projection), sizePx_(sizePx) {}

    glm::ivec2 sizePx() const { return sizePx_; }

    // As unproject gives it (its length may be a distance); NaN in holes.
    glm::dvec3 at(glm::ivec2 px) const {
        const auto ray = projection_->unproject(centreOf(px));
        if (ray)
            if (const double squared = glm::dot(*ray, *ray); std::isfinite(squared) && squared > 0)
                return *ray;
        return glm::dvec3(std::numeric_limits<double>::quiet_NaN());
    }
    static bool isRay(const glm::dvec3& ray) { return !std::isnan(ray.x); }

    // How far from the centre of a pixel with a ray the display shows another ray, to first order; infinite
    // for one that points the other way, and nothing where the neighbours do not tell how the display goes
    // on.
    std::optional<glm::dvec2> offsetPx(glm::ivec2 px, glm::dvec3 ray) const;

private:
    glm::dvec3 directionStep(glm::ivec2 px, const glm::dvec3& centre, int axis) const;

    const Projection* projection_;
    glm::ivec2 sizePx_;
};

}  // namespace curvewall
