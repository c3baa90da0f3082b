#include "renderer/scene/city_buildings.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace curvewall {
namespace {

struct Facade {
    CityMaterial material;
    int variant = 0;
    int topRow = 0;  // the texture's floor that the uppermost floor shows
};

// The corners counter-clockwise seen from above, starting at the front left one; side i runs from corner i to
// i + 1, left to right seen from outside.
std::array<glm::vec2, 4> cornersOf(const Lot& lot) {
    return {{{lot.lowM.x, lot.highM.y},
             {lot.highM.x, lot.highM.y},
             {lot.highM.x, lot.lowM.y},
             {lot.lowM.x, lot.lowM.y}}};
}

int baysOf(glm::vec2 from, glm::vec2 to) {
    return std::max(1, static_cast<int>(std::lround(glm::distance(from, to) / kFloorHeightM)));
}

// One wall of `floors` floors, over a strip of shops of `shopHeightM` unless that is 0. Shops and facade are
// cut at the same places, so that they meet without gaps.
void addWall(MeshBuilder& mesh, glm::vec2 from, glm::vec2 to, float bottomM, float shopHeightM, int floors,
             const Facade& facade, Random& random) {
    const int bays = baysOf(from, to);
    const int segments = (bays + kFacadeVariantBays - 1) / kFacadeVariantBays;
    const float middleM = bottomM + shopHeightM;
    const float topM = middleM + static_cast<float>(floors) * kFloorHeightM;
    const float topV = static_cast<float>(facade.topRow) / kFacadeFloors;
    const float bottomV = static_cast<float>(facade.topRow + floors) / kFacadeFloors;
    uint32_t shop = random.below(kFacadeBays);
    for (int segment = 0; segment < segments; ++segment) {
        const int first = bays * segment / segments, last = bays * (segment + 1) / segments;
        const glm::vec2 left = glm::mix(from, to, static_cast<float>(first) / static_cast<float>(bays));
        const glm::vec2 right = glm::mix(from, to, static_cast<float>(last) / static_cast<float>(bays));
        const int count = last - first;
        const int spare =
            static_cast<int>(random.below(static_cast<uint32_t>(kFacadeVariantBays - count + 1)));
        const int bay = facade.variant * kFacadeVariantBays + spare;
        const float leftU = static_cast<float>(bay) / kFacadeBays;
        const float rightU = static_cast<float>(bay + count) / kFacadeBays;
        mesh.quad(facade.material, {above(left, middleM), {leftU, bottomV}},
                  {above(right, middleM), {rightU, bottomV}}, {above(right, topM), {rightU, topV}},
                  {above(left, topM), {leftU, topV}});
        if (shopHeightM > 0) {
            // A shop is a little wider than a bay: four bays hold three.
            const int shops = std::max(1, count * 3 / 4);
            const float shopU = static_cast<float>(shop) / kFacadeBays;
            const float endU = static_cast<float>(shop + static_cast<uint32_t>(shops)) / kFacadeBays;
            mesh.quad(CityMaterial::shop, {above(left, bottomM), {shopU, 1}},
                      {above(right, bottomM), {endU, 1}}, {above(right, middleM), {endU, 0}},
                      {above(left, middleM), {shopU, 0}});
            shop = (shop + static_cast<uint32_t>(shops)) % kFacadeBays;
        }
    }
}

void addWalls(MeshBuilder& mesh, const Lot& lot, float bottomM, float shopHeightM, int floors,
              const Facade& facade, Random& random) {
    const std::array<glm::vec2, 4> corners = cornersOf(lot);
    for (size_t i = 0; i < 4; ++i)
        addWall(mesh, corners[i], corners[(i + 1) % 4], bottomM, shopHeightM, floors, facade, random);
}

void addFlatRoof(MeshBuilder& mesh, const Lot& lot, float heightM) {
    constexpr float kTextureM = 6;
    const std::array<glm::vec2, 4> c = cornersOf(lot);
    mesh.quad(CityMaterial::flatRoof, {above(c[0], heightM), c[0] / kTextureM},
              {above(c[1], heightM), c[1] / kTextureM}, {above(c[2], heightM), c[2] / kTextureM},
              {above(c[3], heightM), c[3] / kTextureM});
}

// A moulding around the wall that carries on as the parapet of the roof: 32 triangles.
void addParapet(MeshBuilder& mesh, const Lot& lot, float wallTopM, float heightM, Paint paint) {
    constexpr float kOverhangM = 0.3f, kThicknessM = 0.35f;
    const std::array<glm::vec2, 4> wall = cornersOf(lot);
    const std::array<glm::vec2, 4> outer = cornersOf(lot.inset(-kOverhangM));
    const std::array<glm::vec2, 4> inner = cornersOf(lot.inset(kThicknessM));
    const float topM = wallTopM + heightM;
    for (size_t i = 0; i < 4; ++i) {
        const size_t j = (i + 1) % 4;
        mesh.paintedQuad(paint, above(wall[j], wallTopM), above(outer[j], wallTopM),
                         above(outer[i], wallTopM), above(wall[i], wallTopM));
        mesh.paintedQuad(paint, above(outer[i], wallTopM), above(outer[j], wallTopM), above(outer[j], topM),
                         above(outer[i], topM));
        mesh.paintedQuad(paint, above(outer[i], topM), above(outer[j], topM), above(inner[j], topM),
                         above(inner[i], topM));
        mesh.paintedQuad(paint, above(inner[j], wallTopM - 0.05f), above(inner[i], wallTopM - 0.05f),
                         above(inner[i], topM), above(inner[j], topM));
    }
}

Box boxOnRoof(glm::vec2 middle, glm::vec2 size, float bottomM, float heightM) {
    return {above(middle - 0.5f * size, bottomM), above(middle + 0.5f * size, bottomM + heightM)};
}

glm::vec2 placeOn(const Lot& lot, float marginM, Random& random) {
    const Lot inner = lot.inset(marginM);
    return {random.between(inner.lowM.x, inner.highM.x), random.between(inner.lowM.y, inner.highM.y)};
}

// A wooden tank on a frame: 40 triangles.
void addWaterTank(MeshBuilder& mesh, glm::vec2 middle, float roofM) {
    mesh.paintedBox(Paint::darkGrey, boxOnRoof(middle, {1.7f, 1.7f}, roofM, 1.6f), BoxFaces::sides);
    constexpr std::array<glm::vec2, 8> kOctagon{{{1, 0},
                                                 {0.7071f, -0.7071f},
                                                 {0, -1},
                                                 {-0.7071f, -0.7071f},
                                                 {-1, 0},
                                                 {-0.7071f, 0.7071f},
                                                 {0, 1},
                                                 {0.7071f, 0.7071f}}};
    const float bottomM = roofM + 1.6f, topM = roofM + 4.2f, tipM = roofM + 5.3f;
    for (size_t i = 0; i < 8; ++i) {
        const glm::vec2 a = middle + 1.4f * kOctagon[i], b = middle + 1.4f * kOctagon[(i + 1) % 8];
        mesh.paintedQuad(Paint::brown, above(a, bottomM), above(b, bottomM), above(b, topM), above(a, topM));
        mesh.paintedTriangle(Paint::darkGrey, above(a, topM), above(b, topM), above(middle, tipM));
        mesh.paintedTriangle(Paint::darkWood, above(b, bottomM), above(a, bottomM), above(middle, bottomM));
    }
}

void addRoofEquipment(MeshBuilder& mesh, const Lot& lot, float roofM, Random& random) {
    const glm::vec2 shaft(random.between(2.6f, 3.6f), random.between(3.0f, 4.5f));
    mesh.paintedBox(random.chance(0.5f) ? Paint::lightGrey : Paint::sand,
                    boxOnRoof(placeOn(lot, 3.2f, random), shaft, roofM, random.between(2.2f, 3.0f)),
                    BoxFaces::sidesAndTop);
    for (uint32_t units = random.below(3); units > 0; --units)
        mesh.paintedBox(
            Paint::silver,
            boxOnRoof(placeOn(lot, 1.8f, random), {1.6f, 1.1f}, roofM, random.between(0.8f, 1.2f)),
            BoxFaces::sidesAndTop);
    if (random.chance(0.2f)) addWaterTank(mesh, placeOn(lot, 2.6f, random), roofM);
}

// The ridge runs along the longer side.
void addGabledRoof(MeshBuilder& mesh, const Lot& lot, float wallTopM, Paint gable, Detail detail,
                   Random& random) {
    constexpr float kTextureM = 4, kOverhangM = 0.35f;
    const glm::vec2 size = lot.sizeM();
    const glm::vec2 along = size.x >= size.y ? glm::vec2(1, 0) : glm::vec2(0, 1);
    const glm::vec2 across(along.y, -along.x);  // to the left of `along`
    const float halfLength = 0.5f * std::max(size.x, size.y), halfWidth = 0.5f * std::min(size.x, size.y);
    const float pitch = random.between(0.7f, 1.0f);
    const float ridgeM = wallTopM + halfWidth * pitch;
    const float slopeM = std::sqrt(1 + pitch * pitch) * (halfWidth + kOverhangM);
    const auto place = [&](float l, float w, float y) {
        return above(lot.middleM() + l * along + w * across, y);
    };
    const float eavesM = wallTopM - kOverhangM * pitch, end = halfLength + 0.15f;
    for (const float side : {-1.0f, 1.0f}) {
        const float edge = side * (halfWidth + kOverhangM), length = 2 * end / kTextureM,
                    depth = slopeM / kTextureM;
        mesh.quad(CityMaterial::tiles, {place(-side * end, -edge, eavesM), {0, depth}},
                  {place(side * end, -edge, eavesM), {length, depth}},
                  {place(side * end, 0, ridgeM), {length, 0}}, {place(-side * end, 0, ridgeM), {0, 0}});
        mesh.paintedTriangle(gable, place(side * halfLength, -side * halfWidth, wallTopM),
                             place(side * halfLength, side * halfWidth, wallTopM),
                             place(side * halfLength, 0, ridgeM));
    }
    if (detail == Detail::plain) return;
    for (uint32_t chimneys = 1 + random.below(2); chimneys > 0; --chimneys) {
        const glm::vec3 foot =
            place(random.between(-0.8f, 0.8f) * halfLength, random.between(-0.4f, 0.4f) * halfWidth, 0);
        mesh.paintedBox(Paint::rust,
                        boxOnRoof({foot.x, foot.z}, {0.8f, 0.6f}, wallTopM, ridgeM + 0.9f - wallTopM),
                        BoxFaces::sidesAndTop);
    }
}

// Striped sun blinds over the shops of one side: 4 triangles each.
void addAwnings(MeshBuilder& mesh, glm::vec2 from, glm::vec2 to, float heightM, Random& random) {
    constexpr std::array kAwningPaints{Paint::darkRed,  Paint::darkGreen, Paint::cream,
                                       Paint::darkBlue, Paint::orange,    Paint::teal};
    const float length = glm::distance(from, to);
    const glm::vec2 along = (to - from) / length;
    const glm::vec2 out(-along.y, along.x);
    constexpr float kDepthM = 1.2f, kDropM = 0.5f, kValanceM = 0.25f;
    for (float start = 0.6f; start + 3.4f < length; start += 4.1f) {
        if (!random.chance(0.45f)) continue;
        const Paint paint = kAwningPaints[random.below(kAwningPaints.size())];
        const glm::vec2 a = from + start * along, b = a + 3.0f * along;
        const glm::vec2 frontA = a + kDepthM * out, frontB = b + kDepthM * out;
        const float edgeM = heightM - kDropM;
        mesh.paintedQuad(paint, above(frontA, edgeM), above(frontB, edgeM), above(b, heightM),
                         above(a, heightM));
        mesh.paintedQuad(paint, above(frontA, edgeM - kValanceM), above(frontB, edgeM - kValanceM),
                         above(frontB, edgeM), above(frontA, edgeM));
    }
}

// A slab and a railing, open towards the wall: 14 triangles.
void addBalcony(MeshBuilder& mesh, glm::vec2 from, glm::vec2 to, float floorM) {
    constexpr float kDepthM = 1.1f, kSlabM = 0.15f, kRailingM = 0.95f;
    const glm::vec2 along = glm::normalize(to - from);
    const glm::vec2 out = kDepthM * glm::vec2(-along.y, along.x);
    const std::array<glm::vec2, 4> rim{from, from + out, to + out, to};
    for (const float y : {floorM, floorM - kSlabM})
        mesh.paintedQuad(Paint::lightGrey, above(rim[1], y), above(rim[2], y), above(rim[3], y),
                         above(rim[0], y));
    mesh.paintedQuad(Paint::lightGrey, above(rim[1], floorM - kSlabM), above(rim[2], floorM - kSlabM),
                     above(rim[2], floorM), above(rim[1], floorM));
    for (size_t i = 0; i < 3; ++i)
        mesh.paintedQuad(Paint::darkGrey, above(rim[i], floorM + 0.1f), above(rim[i + 1], floorM + 0.1f),
                         above(rim[i + 1], floorM + kRailingM), above(rim[i], floorM + kRailingM));
}

void addBalconies(MeshBuilder& mesh, glm::vec2 from, glm::vec2 to, float firstFloorM, int floors,
                  Random& random) {
    const int bays = baysOf(from, to);
    const auto bay = static_cast<float>(random.below(static_cast<uint32_t>(bays)));
    const glm::vec2 left = glm::mix(from, to, (bay + 0.1f) / static_cast<float>(bays));
    const glm::vec2 right = glm::mix(from, to, (bay + 0.9f) / static_cast<float>(bays));
    for (int floor = 0; floor < floors; ++floor)
        addBalcony(mesh, left, right, firstFloorM + static_cast<float>(floor) * kFloorHeightM + 0.1f);
}

Paint trimFor(CityMaterial facade, Random& random) {
    switch (facade) {
        case CityMaterial::brick:
            return random.chance(0.5f) ? Paint::cream : Paint::lightGrey;
        case CityMaterial::plaster:
            return random.chance(0.5f) ? Paint::white : Paint::sand;
        case CityMaterial::stone:
            return Paint::sand;
        default:
            return Paint::lightGrey;
    }
}

Paint gableFor(CityMaterial facade, int variant) {
    if (facade == CityMaterial::brick) return variant == 0 ? Paint::terracotta : Paint::sand;
    return variant == 0 ? Paint::cream : Paint::lightGrey;
}

}  // namespace

void addHouse(MeshBuilder& mesh, const House& house, Detail detail, Random random) {
    // Never the same height as the neighbour, so that no mouldings share a plane.
    const float groundFloorM = random.between(3.6f, 4.4f);
    const int floors = house.shops ? house.floors : house.floors + 1;
    const float bottomM = kSidewalkHeightM;
    const float shopM = house.shops ? groundFloorM : 0;
    const float socleM = house.shops ? 0 : groundFloorM - kFloorHeightM;
    const float wallTopM = bottomM + shopM + socleM + static_cast<float>(floors) * kFloorHeightM;
    const Facade facade{house.facade, house.variant, static_cast<int>(random.below(kFacadeFloors))};
    const Paint trim = trimFor(house.facade, random);
    const std::array<glm::vec2, 4> corners = cornersOf(house.lot);

    if (socleM > 0)
        mesh.paintedBox(Paint::grey,
                        {above(house.lot.lowM, bottomM), above(house.lot.highM, bottomM + socleM)},
                        BoxFaces::sides);
    addWalls(mesh, house.lot, bottomM + socleM, shopM, floors, facade, random);
    if (house.roof == HouseRoof::gabled) {
        addGabledRoof(mesh, house.lot, wallTopM, gableFor(house.facade, house.variant), detail, random);
    } else if (detail == Detail::plain) {
        addFlatRoof(mesh, house.lot, wallTopM);
    } else {
        addFlatRoof(mesh, house.lot.inset(0.35f), wallTopM - 0.05f);
        addParapet(mesh, house.lot, wallTopM, random.between(0.6f, 1.1f), trim);
        addRoofEquipment(mesh, house.lot, wallTopM - 0.05f, random);
    }
    if (detail == Detail::plain) return;
    for (size_t side = 0; side < 4; ++side) {
        const glm::vec2 from = corners[side], to = corners[(side + 1) % 4];
        if (house.shops) addAwnings(mesh, from, to, bottomM + shopM - 0.9f, random);
    }
    if (house.facade == CityMaterial::plaster && random.chance(0.4f)) {
        const size_t side = random.below(4);
        addBalconies(mesh, corners[side], corners[(side + 1) % 4], bottomM + shopM + socleM, floors, random);
    }
}

void addTower(MeshBuilder& mesh, const Lot& lot, Detail detail, Random random) {
    constexpr int kMaxFloors = 17;  // with the lobby 60 m
    const bool glass = random.chance(0.6f);
    const Facade facade{glass ? CityMaterial::glass : CityMaterial::concrete,
                        static_cast<int>(random.below(2)), static_cast<int>(random.below(kFacadeFloors))};
    const Paint trim = glass ? Paint::grey : Paint::lightGrey;
    int floorsLeft = 11 + static_cast<int>(random.below(kMaxFloors - 10));
    Lot tier = lot;
    float bottomM = kSidewalkHeightM, lobbyM = random.between(4.0f, 4.8f);
    const uint32_t tiers = 2 + random.below(2);
    for (uint32_t i = 0; i < tiers; ++i) {
        const bool isLast = i + 1 == tiers;
        const int floors =
            isLast ? floorsLeft
                   : std::clamp(static_cast<int>(random.between(0.2f, 0.5f) * static_cast<float>(floorsLeft)),
                                2, 6);
        addWalls(mesh, tier, bottomM, lobbyM, floors, facade, random);
        bottomM += lobbyM + static_cast<float>(floors) * kFloorHeightM;
        if (detail == Detail::full) addParapet(mesh, tier, bottomM, isLast ? 1.2f : 0.7f, trim);
        bottomM -= 0.05f;
        addFlatRoof(mesh, tier.inset(detail == Detail::full ? 0.35f : 0.0f), bottomM);
        if (isLast) break;
        floorsLeft -= floors;
        lobbyM = 0;
        tier = tier.inset(random.between(1.8f, 3.2f));
    }
    if (detail == Detail::plain) return;
    addRoofEquipment(mesh, tier, bottomM, random);
    if (random.chance(0.5f))
        mesh.paintedFrustum(Paint::silver,
                            boxOnRoof(tier.middleM(), {0.5f, 0.5f}, bottomM, random.between(6.0f, 12.0f)),
                            0.3f, BoxFaces::sidesAndTop);
}

}  // namespace curvewall
