#include "calibration/pieces/display_outline.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace curvewall {
namespace {

// From one end of a line inwards to the first ray, then back to where the rays begin.
std::optional<glm::dvec2> firstRay(const Projection& projection, glm::dvec2 from, glm::dvec2 to) {
    constexpr int kSteps = 128;
    constexpr int kHalvings = 20;
    const auto at = [&](int i) { return glm::mix(from, to, double(i) / kSteps); };
    for (int i = 0; i <= kSteps; ++i) {
        glm::dvec2 inside = at(i), outside = at(i - 1);
        if (!projection.unproject(inside)) continue;
        for (int halving = 0; i > 0 && halving < kHalvings; ++halving) {
            const glm::dvec2 middle = 0.5 * (inside + outside);
            (projection.unproject(middle) ? inside : outside) = middle;
        }
        return inside;
    }
    return std::nullopt;
}

std::vector<glm::dvec2> endsOfLines(const Projection& projection, glm::dvec2 size) {
    constexpr int kLines = 128;  // each way
    std::vector<glm::dvec2> ends;
    for (int axis = 0; axis < 2; ++axis) {
        for (int line = 0; line <= kLines; ++line) {
            glm::dvec2 from(0), to = size;
            from[1 - axis] = to[1 - axis] = size[1 - axis] * line / kLines;
            for (const auto& end : {firstRay(projection, from, to), firstRay(projection, to, from)})
                if (end) ends.push_back(*end);
        }
    }
    return ends;
}

}  // namespace

std::vector<HalfPlane> displayOutline(const Projection& projection, glm::ivec2 sizePx) {
    constexpr int kDirections = 64;
    constexpr double kRounding = 1e-6;  // of the display
    const glm::dvec2 size(sizePx);
    const std::vector<glm::dvec2> ends = endsOfLines(projection, size);
    if (ends.empty()) return {};
    std::vector<HalfPlane> outline;
    for (int i = 0; i < kDirections; ++i) {
        const bool isSide = i % (kDirections / 4) == 0;
        const double angle = 2 * std::numbers::pi * i / kDirections;
        glm::dvec2 normal(std::cos(angle), std::sin(angle));
        if (isSide) normal = glm::round(normal);
        double offset = -std::numeric_limits<double>::infinity();
        for (glm::dvec2 end : ends) offset = std::max(offset, glm::dot(normal, end));
        const double ofDisplay = glm::dot(glm::max(normal, glm::dvec2(0)), size);
        if (isSide || offset < ofDisplay - kRounding * glm::length(size)) outline.push_back({normal, offset});
    }
    return outline;
}

}  // namespace curvewall
