#include "calibration/pieces/ray_image.h"

#include "calibration/parallel.h"
#include "calibration/pieces/fit_stop.h"

#include <glm/geometric.hpp>

#include <limits>

namespace curvewall {

RayImage::RayImage(const Projection& projection, glm::ivec2 sizePx, const std::stop_token& stop)
    : sizePx_(sizePx), rays_(static_cast<size_t>(sizePx.x) * static_cast<size_t>(sizePx.y)) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    parallelRanges(sizePx.y, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            throwIfStopped(stop);
            for (int x = 0; x < sizePx.x; ++x) {
                const auto ray = projection.unproject(centreOf({x, y}));
                const bool usable = ray && std::isfinite(glm::dot(*ray, *ray)) && glm::dot(*ray, *ray) > 0;
                rays_[indexOf({x, y})] = usable ? *ray : glm::dvec3(kNone);
            }
        }
    });
}

}  // namespace curvewall
