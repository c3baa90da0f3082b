#pragma once
// Where in a pixel its samples lie: the centre for one, a seeded stratified pattern for more.

#include <glm/glm.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace curvewall {

// SplitMix64 (Steele, Lea, Flood: Fast Splittable Pseudorandom Number Generators, 2014).
class SplitMix64 {
public:
    explicit SplitMix64(uint64_t seed) : state_(seed) {}

    uint64_t next() {
        uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

    // In [0, 1).
    double nextUnit() { return static_cast<double>(next() >> 11) * 0x1p-53; }

private:
    uint64_t state_;
};

// Offsets from the pixel's top left corner, in pixels. `seed` alone decides, so that the pattern does not
// depend on who draws the pixel.
inline std::vector<glm::dvec2> samplePattern(int samples, uint64_t seed) {
    if (samples == 1) return {glm::dvec2(0.5)};
    SplitMix64 random(seed);
    std::vector<glm::dvec2> offsets;
    const int side = static_cast<int>(std::lround(std::sqrt(samples)));
    if (side * side == samples) {
        for (int cell = 0; cell < samples; ++cell) {
            const glm::dvec2 jitter{random.nextUnit(), random.nextUnit()};
            offsets.push_back((glm::dvec2(cell % side, cell / side) + jitter) / static_cast<double>(side));
        }
        return offsets;
    }
    // Roberts' R2 sequence, the additive recurrence of the plastic number, shifted anew in every pixel.
    constexpr double kPlastic = 1.32471795724474602596;
    const glm::dvec2 shift{random.nextUnit(), random.nextUnit()};
    for (int i = 0; i < samples; ++i)
        offsets.push_back(glm::fract(shift + glm::dvec2(i / kPlastic, i / (kPlastic * kPlastic))));
    return offsets;
}

}  // namespace curvewall
