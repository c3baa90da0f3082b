#pragma once
// Seeded randomness that is the same on every machine: std::distributions are not.

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <random>

namespace curvewall::test {

class Random {
public:
    explicit Random(uint64_t seed) : engine_(seed) {}

    double uniform(double least, double most) {
        return least + (most - least) * static_cast<double>(engine_() >> 11) * 0x1.0p-53;
    }
    glm::dvec2 pixel(glm::ivec2 sizePx) { return {uniform(0, sizePx.x), uniform(0, sizePx.y)}; }
    glm::dvec3 inBox(double halfSize) {
        return {uniform(-halfSize, halfSize), uniform(-halfSize, halfSize), uniform(-halfSize, halfSize)};
    }
    glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 candidate = inBox(1);
            const double length = glm::length(candidate);
            if (length > 0.1 && length <= 1) return candidate / length;
        }
    }

private:
    std::mt19937_64 engine_;
};

}  // namespace curvewall::test
