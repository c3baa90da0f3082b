#include "renderer/scene/city_streets.h"

#include "renderer/scene/city_furniture.h"
#include "renderer/scene/random.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace curvewall {
namespace {

constexpr float kMarkingHeightM = 0.025f;
constexpr float kLawnHeightM = kSidewalkHeightM + 0.04f;

void addPlane(MeshBuilder& mesh, CityMaterial material, const Lot& lot, float heightM, float textureM) {
    const glm::vec2 low = lot.lowM, high = lot.highM;
    const auto corner = [&](float x, float z) { return Corner{{x, heightM, z}, glm::vec2(x, z) / textureM}; };
    mesh.quad(material, corner(low.x, high.y), corner(high.x, high.y), corner(high.x, low.y),
              corner(low.x, low.y));
}

void addMarking(MeshBuilder& mesh, glm::vec2 middle, glm::vec2 size) {
    addPlane(mesh, CityMaterial::marking, {middle - 0.5f * size, middle + 0.5f * size}, kMarkingHeightM, 1);
}

// The dashed middle lines along the block's two low sides, and the zebra crossings at its low corner.
void addMarkings(MeshBuilder& mesh, const Block& block) {
    const glm::vec2 crossing = block.crossingM;
    for (float z = block.kerb.lowM.y + 6; z < block.kerb.highM.y - 5; z += 5)
        addMarking(mesh, {crossing.x, z}, {0.14f, 2.2f});
    for (float x = block.kerb.lowM.x + 6; x < block.kerb.highM.x - 5; x += 5)
        addMarking(mesh, {x, crossing.y}, {2.2f, 0.14f});
    constexpr float kFromCrossingM = 7;
    for (float offset = -3.1f; offset < 3.5f; offset += 1.24f)
        for (const float side : {-kFromCrossingM, kFromCrossingM}) {
            addMarking(mesh, crossing + glm::vec2(side, offset), {2.4f, 0.55f});
            addMarking(mesh, crossing + glm::vec2(offset, side), {0.55f, 2.4f});
        }
}

// What stands along one side of the block, on the sidewalk and in the road. `front` looks to the street.
void planSide(std::vector<StreetItem>& items, glm::vec2 from, glm::vec2 to, glm::vec2 front, Random& random) {
    const float length = glm::distance(from, to);
    const glm::vec2 along = (to - from) / length;
    const auto spot = [&](float distance, float fromKerbM, glm::vec2 look) {
        const float y = fromKerbM < 0 ? kSidewalkHeightM : 0;
        return Spot{above(from + distance * along + fromKerbM * front, y), above(look, 0)};
    };
    uint32_t slot = random.below(2);
    for (float distance = 4; distance < length - 4; distance += 4.2f, ++slot) {
        const Spot place = spot(distance, -0.7f, front);
        const uint64_t key = static_cast<uint64_t>(random.bits()) << 32 | random.bits();
        if (slot % 4 == 0) {
            items.emplace_back([place](MeshBuilder& mesh) { addStreetLamp(mesh, place); });
        } else if (slot % 2 == 1) {
            items.emplace_back([place, key](MeshBuilder& mesh) { addBroadleaf(mesh, place, Random(key)); });
        } else {
            switch (random.below(5)) {
                case 0:
                    items.emplace_back([place](MeshBuilder& mesh) { addBench(mesh, place); });
                    break;
                case 1:
                    items.emplace_back([place](MeshBuilder& mesh) { addLitterBin(mesh, place); });
                    break;
                case 2:
                    items.emplace_back([place](MeshBuilder& mesh) { addHydrant(mesh, place); });
                    break;
                case 3:
                    items.emplace_back(
                        [place, key](MeshBuilder& mesh) { addTrafficSign(mesh, place, Random(key)); });
                    break;
                default:
                    items.emplace_back([place](MeshBuilder& mesh) { addBollard(mesh, place); });
                    break;
            }
        }
    }
    // Traffic keeps to the right: with the block on its right hand, a car drives along +(front x up).
    const bool isParking = random.chance(0.55f);
    const glm::vec2 drive = along;
    const float spacing = isParking ? 6.2f : 14.0f;
    for (float distance = 6.5f; distance < length - 6;
         distance += spacing + random.between(0, isParking ? 2.0f : 12.0f)) {
        const Spot place = spot(distance, isParking ? 1.0f : 1.9f, drive);
        const uint64_t key = random.bits();
        items.emplace_back([place, key](MeshBuilder& mesh) { addCar(mesh, place, Random(key)); });
    }
    const Spot corner = spot(length - 1.9f, -0.5f, -along);
    const uint64_t key = random.bits();
    items.emplace_back([corner, key](MeshBuilder& mesh) { addTrafficLight(mesh, corner, Random(key)); });
}

void planTrees(std::vector<StreetItem>& items, const Lot& area, int count, float conifers, float heightM,
               Random& random) {
    for (int i = 0; i < count; ++i) {
        const Spot place{
            {random.between(area.lowM.x, area.highM.x), heightM, random.between(area.lowM.y, area.highM.y)},
            {0, 0, 1}};
        const uint64_t key = random.bits();
        if (random.chance(conifers))
            items.emplace_back([place, key](MeshBuilder& mesh) { addConifer(mesh, place, Random(key)); });
        else
            items.emplace_back([place, key](MeshBuilder& mesh) { addBroadleaf(mesh, place, Random(key)); });
    }
}

// Trees and benches where the plaza has no tower.
void planPlaza(std::vector<StreetItem>& items, const Block& block, Random& random) {
    const std::vector<Lot> towers = planTowers(block);
    const auto isFree = [&](glm::vec2 p) {
        return std::none_of(towers.begin(), towers.end(), [&](const Lot& tower) {
            const Lot taken = tower.inset(-2.5f);
            return glm::all(glm::lessThan(taken.lowM, p)) && glm::all(glm::lessThan(p, taken.highM));
        });
    };
    const Lot area = block.buildable();
    for (float z = area.lowM.y + 2; z < area.highM.y - 1; z += 5.5f)
        for (float x = area.lowM.x + 2; x < area.highM.x - 1; x += 5.5f) {
            const Spot place{{x, kSidewalkHeightM, z},
                             random.chance(0.5f) ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0)};
            const uint64_t key = random.bits();
            if (!isFree({x, z})) continue;
            if (random.chance(0.7f))
                items.emplace_back(
                    [place, key](MeshBuilder& mesh) { addBroadleaf(mesh, place, Random(key)); });
            else
                items.emplace_back([place](MeshBuilder& mesh) { addBench(mesh, place); });
        }
}

void planPark(std::vector<StreetItem>& items, const Block& block, Random& random) {
    const Lot lawn = block.buildable();
    const glm::vec2 middle = lawn.middleM(), half = 0.5f * lawn.sizeM();
    const float groundM = kLawnHeightM;
    items.emplace_back([=](MeshBuilder& mesh) {
        addPlane(mesh, CityMaterial::sidewalk,
                 {{lawn.lowM.x, middle.y - 1.5f}, {lawn.highM.x, middle.y + 1.5f}}, groundM + 0.03f, 4);
        for (const float side : {-1.0f, 1.0f}) {
            const glm::vec2 end(middle.x, middle.y + side * half.y), start(middle.x, middle.y + side * 1.5f);
            const glm::vec2 width(1.5f, 0);
            addPlane(mesh, CityMaterial::sidewalk,
                     {glm::min(start, end) - width, glm::max(start, end) + width}, groundM + 0.03f, 4);
        }
    });
    items.emplace_back([=](MeshBuilder& mesh) {
        addFountain(mesh, {above(middle, groundM + 0.03f), {0, 0, 1}});
    });
    for (const glm::vec2 quarter : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(-1, 1), glm::vec2(1, 1)}) {
        const glm::vec2 inner = middle + quarter * 4.5f, outer = middle + quarter * (half - 2.0f);
        planTrees(items, {glm::min(inner, outer), glm::max(inner, outer)}, 8, 0.3f, groundM, random);
        const Spot bench{above(middle + quarter * glm::vec2(5.0f, 2.1f), groundM), above({0, -quarter.y}, 0)};
        items.emplace_back([bench](MeshBuilder& mesh) { addBench(mesh, bench); });
    }
}

}  // namespace

void addSidewalk(MeshBuilder& mesh, const Block& block) {
    constexpr float kChamferM = 1.5f, kSlabsM = 4;
    const glm::vec2 low = block.kerb.lowM, high = block.kerb.highM;
    const std::array<glm::vec2, 8> ring{{{low.x + kChamferM, high.y},
                                         {high.x - kChamferM, high.y},
                                         {high.x, high.y - kChamferM},
                                         {high.x, low.y + kChamferM},
                                         {high.x - kChamferM, low.y},
                                         {low.x + kChamferM, low.y},
                                         {low.x, low.y + kChamferM},
                                         {low.x, high.y - kChamferM}}};
    const auto corner = [](glm::vec2 p, float y) {
        return Corner{above(p, y), (p + glm::vec2(0, y)) / kSlabsM};
    };
    for (size_t i = 0; i < ring.size(); ++i) {
        const glm::vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
        mesh.quad(CityMaterial::sidewalk, corner(a, 0), corner(b, 0), corner(b, kSidewalkHeightM),
                  corner(a, kSidewalkHeightM));
        if (i >= 1 && i + 1 < ring.size())
            mesh.triangle(CityMaterial::sidewalk, corner(ring[0], kSidewalkHeightM),
                          corner(a, kSidewalkHeightM), corner(b, kSidewalkHeightM));
    }
}

void addLawn(MeshBuilder& mesh, const Lot& lot) {
    constexpr float kTextureM = 9;
    addPlane(mesh, CityMaterial::grass, lot, kLawnHeightM, kTextureM);
}

std::vector<StreetItem> planStreetItems(const Block& block) {
    Random random(block.key + 3);
    std::vector<StreetItem> items;
    const glm::vec2 low = block.kerb.lowM, high = block.kerb.highM;
    planSide(items, {low.x, high.y}, high, {0, 1}, random);
    planSide(items, high, {high.x, low.y}, {1, 0}, random);
    planSide(items, {high.x, low.y}, low, {0, -1}, random);
    planSide(items, low, {low.x, high.y}, {-1, 0}, random);
    const Lot area = block.buildable();
    switch (block.kind) {
        case BlockKind::houses:
            // The courtyard, whatever the depth of the houses.
            items.emplace_back([area](MeshBuilder& mesh) { addLawn(mesh, area.inset(14.5f)); });
            planTrees(items, area.inset(16.5f), 2, 0.2f, kSidewalkHeightM, random);
            break;
        case BlockKind::towers:
            planPlaza(items, block, random);
            break;
        case BlockKind::park:
            break;
    }
    for (size_t i = items.size(); i > 1; --i)
        std::swap(items[i - 1], items[random.below(static_cast<uint32_t>(i))]);

    std::vector<StreetItem> first{[block](MeshBuilder& mesh) { addMarkings(mesh, block); }};
    if (block.kind == BlockKind::park) planPark(first, block, random);
    first.insert(first.end(), items.begin(), items.end());
    return first;
}

}  // namespace curvewall
