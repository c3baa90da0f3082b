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

// How the ray of a display changes from px, per pixel of the step.
std::optional<glm::dvec3> changeAlong(const Display& display, glm::dvec2 px, glm::dvec3 seen,
                                      glm::dvec2 step) {
    const auto aside = display.projection->unproject(px + step);
    if (!aside) return std::nullopt;
    return (glm::normalize(*aside) - seen) / (step.x + step.y);
}

// The offset, in pixels, that changes the ray by `change`, or comes nearest to it.
glm::dvec2 offsetThatChanges(glm::dvec3 change, glm::dvec3 perColumn, glm::dvec3 perRow) {
    const double across = glm::dot(perColumn, perColumn), both = glm::dot(perColumn, perRow),
                 down = glm::dot(perRow, perRow);
    const glm::dvec2 sides(glm::dot(perColumn, change), glm::dot(perRow, change));
    return glm::dvec2(down * sides.x - both * sides.y, across * sides.y - both * sides.x) /
           (across * down - both * both);
}

}  // namespace

PixelDistance::PixelDistance(const Display& display)
    : display_(display), isClosed_(closesOnItself(display)) {}

std::optional<double> PixelDistance::from(glm::dvec2 px, glm::dvec3 ray) const {
    std::optional<double> least;
    for (const glm::dvec2 at : display_.projection->project(ray)) {
        glm::dvec2 offset = glm::abs(at - px);
        if (isClosed_) offset.x = std::min(offset.x, std::abs(display_.sizePx.x - offset.x));
        const double distance = glm::length(offset);
        least = std::min(distance, least.value_or(distance));
    }
    return least ? least : acrossTheBorder(px, ray);
}

// A point that is shown by a pixel on the border may lie half a rounding beyond it, where projections know
// nothing. From the pixel's own ray it is told straight on, by how the ray changes towards each corner of the
// pixel that has rays: the most of them, so that no error is told too small.
std::optional<double> PixelDistance::acrossTheBorder(glm::dvec2 px, glm::dvec3 ray) const {
    constexpr double kFarthestPx = 2;  // straight on is right for no more
    const auto ownRay = display_.projection->unproject(px);
    if (!ownRay) return std::nullopt;
    const glm::dvec3 seen = glm::normalize(*ownRay), change = glm::normalize(ray) - seen;
    if (glm::dot(seen, ray) <= 0) return std::nullopt;
    std::optional<double> most;
    for (const double aside : {-0.5, 0.5})
        for (const double below : {-0.5, 0.5}) {
            const auto perColumn = changeAlong(display_, px, seen, {aside, 0}),
                       perRow = changeAlong(display_, px, seen, {0, below});
            if (!perColumn || !perRow) continue;
            const double distance = glm::length(offsetThatChanges(change, *perColumn, *perRow));
            if (!(distance < kFarthestPx)) return std::nullopt;
            most = std::max(distance, most.value_or(distance));
        }
    return most;
}

std::vector<float> shownErrorsPx(const Frame& position, const Display& display) {
    std::vector<float> errors(position.texels.size() / 3, std::numeric_limits<float>::quiet_NaN());
    const PixelDistance distance(display);
    parallelRanges(position.sizePx.y, [&](int begin, int end) {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < position.sizePx.x; ++x) {
                const float* const texel = position.at(x, y);
                if (!std::isfinite(texel[0] + texel[1] + texel[2])) continue;
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
