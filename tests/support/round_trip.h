#pragma once
// Whether pixels come back: project(unproject(p)) is p.

#include "calibration/projections/lens_projection.h"
#include "tests/support/random_numbers.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace curvewall::test {

struct RoundTrip {
    double worstPx = 0;  // infinite where a pixel with a ray has no position
    int holes = 0;
    int wrongHoles = 0;  // pixels that are holes and should not be, or the other way round
};

// Random pixels; where the picture is a full turn wide or high, `turnPx` is that side, and distances are
// modulo it.
inline RoundTrip roundTrip(
    const Projection& projection, glm::ivec2 sizePx, uint64_t seed,
    const std::function<bool(glm::dvec2)>& isHole = [](glm::dvec2) { return false; },
    glm::dvec2 turnPx = glm::dvec2(std::numeric_limits<double>::infinity()), int count = 100'000) {
    Random random(seed);
    RoundTrip result;
    for (int i = 0; i < count; ++i) {
        const glm::dvec2 px = random.pixel(sizePx);
        const auto ray = projection.unproject(px);
        result.wrongHoles += ray.has_value() == isHole(px);
        result.holes += !ray;
        if (!ray) continue;
        double nearest = std::numeric_limits<double>::infinity();
        for (const glm::dvec2 back : projection.project(*ray)) {
            const glm::dvec2 off = glm::abs(back - px);
            nearest = std::min(nearest, glm::length(glm::min(off, glm::abs(turnPx - off))));
        }
        if (!(nearest <= result.worstPx)) result.worstPx = nearest;
    }
    return result;
}

inline Orientation anyOrientation(Random& random) {
    return {random.uniform(-3, 3), random.uniform(-1.5, 1.5), random.uniform(-3, 3)};
}

}  // namespace curvewall::test
