#pragma once
// Displays with every way of being broken that a measured map may have, as rays of pixels.

#include "tests/support/random_numbers.h"
#include "tests/support/test_projections.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

namespace curvewall::test {

using RayAt = RayFunctionProjection::RayAt;

// A flat screen 90 degrees wide.
inline RayAt flatRays(glm::ivec2 sizePx) {
    const double w = sizePx.x, h = sizePx.y;
    return [w, h](glm::dvec2 px) { return glm::dvec3(2 * px.x / w - 1, (h - 2 * px.y) / w, -1); };
}

// An equidistant fisheye of 180 degrees with nothing outside of its circle.
inline RayAt fisheyeRays(glm::ivec2 sizePx) {
    const glm::dvec2 centre = 0.5 * glm::dvec2(sizePx);
    const double radius = std::min(centre.x, centre.y);
    return [centre, radius](glm::dvec2 px) -> std::optional<glm::dvec3> {
        const glm::dvec2 d = (px - centre) / radius;
        const double r = glm::length(d);
        if (r > 1) return std::nullopt;
        if (r == 0) return glm::dvec3(0, 0, -1);
        const double angle = r * std::numbers::pi / 2;
        return glm::dvec3(std::sin(angle) * d.x / r, -std::sin(angle) * d.y / r, -std::cos(angle));
    };
}

// A number from 0 to 1 for each pixel, unlike those of all others.
inline double noiseAt(glm::dvec2 px, uint64_t seed) {
    const auto x = static_cast<uint64_t>(px.x), y = static_cast<uint64_t>(px.y);
    return Random(x + (y << 20) + (seed << 40)).uniform(0, 1);
}

// Pixels are missing where `isMissing` says so.
template <class IsMissing>
RayAt withHoles(RayAt rays, IsMissing isMissing) {
    return [rays = std::move(rays), isMissing](glm::dvec2 px) -> std::optional<glm::dvec3> {
        if (isMissing(px)) return std::nullopt;
        return rays(px);
    };
}

// Pixels show what others should, `shift(px)` away.
template <class Shift>
RayAt displaced(RayAt rays, Shift shift) {
    return [rays = std::move(rays), shift](glm::dvec2 px) { return rays(px + shift(px)); };
}

inline RayAt randomRays() {
    return [](glm::dvec2 px) {
        return Random(static_cast<uint64_t>(px.x) + (static_cast<uint64_t>(px.y) << 20)).direction();
    };
}

}  // namespace curvewall::test
