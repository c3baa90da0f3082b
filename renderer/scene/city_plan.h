#pragma once
// Where the city's streets, blocks and houses are.

#include "renderer/scene/city_buildings.h"
#include "renderer/scene/random.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <vector>

namespace curvewall {

inline constexpr float kHalfRoadM = 4;  // with the sidewalks a street is 14 m wide
inline constexpr float kSidewalkM = 3;

// The middle lines of the streets, ascending. One of each runs through the origin.
struct StreetGrid {
    std::vector<float> xM;
    std::vector<float> zM;
};

enum class BlockKind { houses, towers, park };

struct Block {
    Lot kerb;             // up to the road
    glm::vec2 crossingM;  // of the streets at its low corner
    BlockKind kind = BlockKind::houses;
    uint64_t key = 0;  // of its random numbers

    Lot buildable() const { return kerb.inset(kSidewalkM); }
};

// The key of the random numbers for one purpose at one place.
enum class KeyPurpose : uint32_t { xStreets = 1, zStreets = 2, hills = 4, leaves = 5, block = 10 };
uint64_t keyFrom(uint32_t seed, KeyPurpose purpose, int a, int b);

// As square as the number of blocks allows; at least the four blocks around the crossing.
StreetGrid planStreets(uint32_t triangles, uint32_t seed);

// From the middle of the city outwards.
std::vector<Block> planBlocks(const StreetGrid& grid, uint32_t seed);

// Houses along all four streets around a courtyard.
std::vector<House> planHouses(const Block& block);

// Two towers on a plaza, across from each other.
std::vector<Lot> planTowers(const Block& block);

}  // namespace curvewall
