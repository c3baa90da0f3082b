#pragma once
// A part of a scene whose pairs no buffer can hold is drawn as two.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace curvewall {

// Splits those that need more. `needed` are the pairs of each part. A Part has isSplittable() and halves(), a
// pair of Parts. Throws std::runtime_error, and leaves all as it is, where one cannot be split.
template <class Part, class Count>
void splitParts(std::vector<Part>& parts, const std::vector<Count>& needed, uint64_t mostPairs) {
    for (size_t i = 0; i < parts.size(); ++i)
        if (needed[i] > mostPairs && !parts[i].isSplittable())
            throw std::runtime_error("a buffer of this OpenGL holds " + std::to_string(mostPairs) +
                                     " (triangle, piece) pairs, and a few triangles have more; a larger "
                                     "tolerance needs fewer");
    std::vector<Part> split;
    for (size_t i = 0; i < parts.size(); ++i) {
        if (needed[i] <= mostPairs) {
            split.push_back(std::move(parts[i]));
        } else {
            auto [first, second] = parts[i].halves();
            split.push_back(std::move(first));
            split.push_back(std::move(second));
        }
    }
    parts = std::move(split);
}

// What a frame asks for: the pairs to have room for from now on, with parts split where no buffer
// holds theirs. Nothing where all pairs had room.
template <class Part, class Count>
std::optional<uint32_t> roomFor(std::vector<Part>& parts, const std::vector<Count>& needed, uint32_t capacity,
                                uint32_t mostPairs) {
    const uint64_t most = needed.empty() ? 0 : *std::ranges::max_element(needed);
    if (most <= capacity) return std::nullopt;
    if (most > mostPairs) splitParts(parts, needed, mostPairs);
    return static_cast<uint32_t>(std::min<uint64_t>(most + most / 2, mostPairs));
}

}  // namespace curvewall
