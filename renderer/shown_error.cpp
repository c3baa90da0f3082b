#include "renderer/shown_error.h"

#include "calibration/parallel.h"
#include "calibration/pieces/ownership.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvewall {
namespace {

bool isClosed(const Display& display) {
    const double middle = 0.5 * display.sizePx.y;
    const auto left = display.projection->unproject({0, middle});
    const auto right = display.projection->unproject({display.sizePx.x, middle});
    return left && right && glm::distance(glm::normalize(*left), glm::normalize(*right)) < 1e-9;
}

}  // namespace

PixelDistance::PixelDistance(const Display& display) : display_(display), isClosed_(isClosed(display)) {}

std::optional<double> PixelDistance::from(glm::dvec2 px, glm::dvec3 ray) const {
    std::optional<double> least;
    for (const glm::dvec2 at : display_.projection->project(ray)) {
        glm::dvec2 offset = glm::abs(at - px);
        if (isClosed_) offset.x = std::min(offset.x, std::abs(display_.sizePx.x - offset.x));
        const double distance = glm::length(offset);
        least = std::min(distance, least.value_or(distance));
    }
    return least;
}

std::vector<float> shownErrorsPx(const Frame& position, const Display& display) {
    std::vector<float> errors(position.texels.size() / 3, std::numeric_limits<float>::quiet_NaN());
    const PixelDistance distance(display);
    parallelRanges(position.sizePx.y, [&](int begin, int end) {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < position.sizePx.x; ++x) {
                const float* const texel = position.at(x, y);
                if (std::isnan(texel[0])) continue;
                constexpr double kNowhere = std::numeric_limits<double>::infinity();
                errors[static_cast<size_t>(y) * static_cast<size_t>(position.sizePx.x) +
                       static_cast<size_t>(x)] =
                    static_cast<float>(
                        distance.from(centreOf({x, y}), {texel[0], texel[1], texel[2]}).value_or(kNowhere));
            }
    });
    return errors;
}

Certificate shownError(const Frame& position, const Display& display) {
    const std::vector<float> errors = shownErrorsPx(position, display);
    const std::vector<int32_t> owners(errors.size(), 0);
    return certificateOf(errors, owners, position.sizePx);
}

}  // namespace curvewall
