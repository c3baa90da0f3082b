#include "renderer/scene/city_plan.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>

namespace curvewall {
namespace {

constexpr uint32_t kTrianglesPerBlock = 1'400;  // what a block looks finished with

std::vector<float> streetLines(uint32_t blocks, uint32_t seed, KeyPurpose axis) {
    constexpr std::array kPitchesM{50.0f, 56.0f, 62.0f, 68.0f};
    const auto pitch = [&](int block) {
        return kPitchesM[Random(keyFrom(seed, axis, block, 0)).below(kPitchesM.size())];
    };
    const int below = static_cast<int>(blocks / 2), above = static_cast<int>(blocks) - below;
    std::vector<float> lines{0};
    for (int i = 1; i <= below; ++i) lines.push_back(lines.back() - pitch(-i));
    std::reverse(lines.begin(), lines.end());
    for (int i = 0; i < above; ++i) lines.push_back(lines.back() + pitch(i));
    return lines;
}

BlockKind kindOf(size_t rank, Random random) {
    // The picture from the default camera: houses on three corners, towers on the fourth, a park near by.
    if (rank < 4) return rank == 2 ? BlockKind::towers : BlockKind::houses;
    if (rank == 5) return BlockKind::park;
    const uint32_t die = random.below(16);
    return die == 0 ? BlockKind::park : die < 5 ? BlockKind::towers : BlockKind::houses;
}

// Cuts a stretch into lots of 10 to 18 m; the cuts include both ends.
std::vector<float> cutIntoLots(float from, float to, Random& random) {
    std::vector<float> cuts{from};
    while (to - cuts.back() > 20) {
        const float width = random.between(10.5f, 18.0f);
        cuts.push_back(to - cuts.back() - width < 10 ? 0.5f * (cuts.back() + to) : cuts.back() + width);
    }
    cuts.push_back(to);
    return cuts;
}

House planHouse(const Lot& lot, int floors, Random& random) {
    constexpr std::array kFacades{CityMaterial::brick,   CityMaterial::brick, CityMaterial::plaster,
                                  CityMaterial::plaster, CityMaterial::stone, CityMaterial::stone,
                                  CityMaterial::concrete};
    House house;
    house.lot = lot;
    house.facade = kFacades[random.below(kFacades.size())];
    house.variant = static_cast<int>(random.below(2));
    house.floors = floors + static_cast<int>(random.below(4)) - 1;
    if (random.chance(0.12f)) house.floors += 3;
    house.floors = std::max(1, house.floors);
    const bool mayBeGabled = house.floors <= 5 && house.facade != CityMaterial::concrete;
    house.roof = mayBeGabled && random.chance(0.6f) ? HouseRoof::gabled : HouseRoof::flat;
    house.shops = random.chance(0.6f);
    return house;
}

constexpr float kGapM = 0.12f;  // between neighbours, so that no walls share a plane

}  // namespace

uint64_t keyFrom(uint32_t seed, KeyPurpose purpose, int a, int b) {
    const uint64_t place = static_cast<uint64_t>(static_cast<uint32_t>(a)) << 32 | static_cast<uint32_t>(b);
    return mixedBits(mixedBits(place) ^ (static_cast<uint64_t>(seed) << 32 | static_cast<uint32_t>(purpose)));
}

StreetGrid planStreets(uint32_t triangles, uint32_t seed) {
    const uint32_t wanted = std::max(4u, triangles / kTrianglesPerBlock);
    uint32_t columns = 2, rows = 2;
    for (;;) {
        uint32_t& shorter = columns <= rows ? columns : rows;
        ++shorter;
        if (columns * rows <= wanted) continue;
        --shorter;
        return {streetLines(columns, seed, KeyPurpose::xStreets),
                streetLines(rows, seed, KeyPurpose::zStreets)};
    }
}

std::vector<Block> planBlocks(const StreetGrid& grid, uint32_t seed) {
    std::vector<Block> blocks;
    for (size_t row = 0; row + 1 < grid.zM.size(); ++row)
        for (size_t column = 0; column + 1 < grid.xM.size(); ++column) {
            const glm::vec2 low(grid.xM[column], grid.zM[row]), high(grid.xM[column + 1], grid.zM[row + 1]);
            blocks.push_back(
                {Lot{low, high}.inset(kHalfRoadM), low, BlockKind::houses,
                 keyFrom(seed, KeyPurpose::block, static_cast<int>(low.x), static_cast<int>(low.y))});
        }
    const auto distance = [](const Block& block) {
        return glm::dot(block.kerb.middleM(), block.kerb.middleM());
    };
    std::stable_sort(blocks.begin(), blocks.end(),
                     [&](const Block& a, const Block& b) { return distance(a) < distance(b); });
    for (size_t i = 0; i < blocks.size(); ++i) blocks[i].kind = kindOf(i, Random(blocks[i].key));
    return blocks;
}

std::vector<House> planHouses(const Block& block) {
    Random random(block.key + 1);
    const Lot area = block.buildable();
    const float depth = random.between(11.5f, 14.0f);
    const int floors = 2 + static_cast<int>(random.below(5));
    std::vector<House> houses;
    const auto add = [&](glm::vec2 low, glm::vec2 high) {
        houses.push_back(planHouse(Lot{low, high}.inset(0.5f * kGapM), floors, random));
    };
    for (const bool isLow : {true, false}) {
        const float z = isLow ? area.lowM.y : area.highM.y - depth;
        const std::vector<float> cuts = cutIntoLots(area.lowM.x, area.highM.x, random);
        for (size_t i = 0; i + 1 < cuts.size(); ++i) add({cuts[i], z}, {cuts[i + 1], z + depth});
    }
    for (const bool isLow : {true, false}) {
        const float x = isLow ? area.lowM.x : area.highM.x - depth;
        const std::vector<float> cuts = cutIntoLots(area.lowM.y + depth, area.highM.y - depth, random);
        for (size_t i = 0; i + 1 < cuts.size(); ++i) add({x, cuts[i]}, {x + depth, cuts[i + 1]});
    }
    return houses;
}

std::vector<Lot> planTowers(const Block& block) {
    Random random(block.key + 2);
    const Lot area = block.buildable().inset(1.0f);
    const glm::vec2 first(random.between(15.5f, 0.52f * area.sizeM().x),
                          random.between(15.5f, 0.46f * area.sizeM().y));
    const glm::vec2 second(random.between(15.5f, 0.52f * area.sizeM().x),
                           random.between(15.5f, 0.46f * area.sizeM().y));
    if (random.chance(0.5f)) return {{area.lowM, area.lowM + first}, {area.highM - second, area.highM}};
    return {{{area.highM.x - first.x, area.lowM.y}, {area.highM.x, area.lowM.y + first.y}},
            {{area.lowM.x, area.highM.y - second.y}, {area.lowM.x + second.x, area.highM.y}}};
}

}  // namespace curvewall
