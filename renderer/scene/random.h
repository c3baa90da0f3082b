#pragma once
// Random numbers that are the same on every machine and with every standard library: PCG32 (O'Neill 2014).

#include <cstdint>

namespace curvewall {

// Mixes all bits (the finaliser of SplitMix64).
constexpr uint64_t mixedBits(uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

class Random {
public:
    // Equal keys give equal sequences.
    explicit constexpr Random(uint64_t key) : state_(mixedBits(key)) {}

    constexpr uint32_t bits() {
        const uint64_t old = state_;
        state_ = old * 6364136223846793005u + 1442695040888963407u;
        const auto shifted = static_cast<uint32_t>(((old >> 18) ^ old) >> 27);
        const auto turn = static_cast<uint32_t>(old >> 59);
        return (shifted >> turn) | (shifted << ((32 - turn) & 31));
    }

    // 0 <= n < count
    constexpr uint32_t below(uint32_t count) {
        return static_cast<uint32_t>((static_cast<uint64_t>(bits()) * count) >> 32);
    }

    // low <= x < high, on a grid of 2^-24 of the range
    constexpr float between(float low, float high) {
        return low + (high - low) * (static_cast<float>(bits() >> 8) * 0x1p-24f);
    }

    constexpr bool chance(float probability) { return between(0, 1) < probability; }

private:
    uint64_t state_;
};

}  // namespace curvewall
