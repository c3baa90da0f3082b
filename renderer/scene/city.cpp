// The ground of the city, and how the triangles are shared out over its blocks.

#include "renderer/scene/city.h"

#include "renderer/scene/city_buildings.h"
#include "renderer/scene/city_furniture.h"
#include "renderer/scene/city_materials.h"
#include "renderer/scene/city_plan.h"
#include "renderer/scene/city_streets.h"
#include "renderer/scene/mesh_builder.h"
#include "renderer/scene/random.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <vector>

namespace curvewall {
namespace {

constexpr float kBuildingShare = 0.8f;  // of the triangles at most; the rest is for the streets

// The asphalt under the whole city is one plane and the country around it shares its corners: nothing below
// the horizon can show through.
void addGround(MeshBuilder& mesh, const StreetGrid& grid, uint32_t triangles, uint32_t seed) {
    constexpr float kAsphaltM = 8, kGrassM = 14;
    const Lot city =
        Lot{{grid.xM.front(), grid.zM.front()}, {grid.xM.back(), grid.zM.back()}}.inset(-kHalfRoadM);
    const std::array<glm::vec2, 4> inner{
        {{city.lowM.x, city.highM.y}, city.highM, {city.highM.x, city.lowM.y}, city.lowM}};
    const auto corner = [](glm::vec2 p, float textureM) { return Corner{above(p, 0), p / textureM}; };
    mesh.quad(CityMaterial::asphalt, corner(inner[0], kAsphaltM), corner(inner[1], kAsphaltM),
              corner(inner[2], kAsphaltM), corner(inner[3], kAsphaltM));

    const float widthM = std::max(600.0f, 0.25f * (city.sizeM().x + city.sizeM().y));
    const Lot country = city.inset(-widthM);
    const std::array<glm::vec2, 4> outer{
        {{country.lowM.x, country.highM.y}, country.highM, {country.highM.x, country.lowM.y}, country.lowM}};
    const int hills = triangles < 5'000 ? 2 : 12;  // a side
    Random random(keyFrom(seed, KeyPurpose::hills, 0, 0));
    std::vector<float> hillM(static_cast<size_t>(4 * hills));
    for (float& height : hillM) height = random.between(18.0f, 60.0f);
    for (size_t side = 0; side < 4; ++side) {
        const size_t next = (side + 1) % 4;
        mesh.triangle(CityMaterial::grass, corner(inner[side], kGrassM), corner(outer[next], kGrassM),
                      corner(inner[next], kGrassM));
        for (int i = 0; i < hills; ++i) {
            const auto n = static_cast<float>(hills);
            const glm::vec2 a = glm::mix(outer[side], outer[next], static_cast<float>(i) / n);
            const glm::vec2 b = i + 1 == hills
                                    ? outer[next]
                                    : glm::mix(outer[side], outer[next], static_cast<float>(i + 1) / n);
            mesh.triangle(CityMaterial::grass, corner(inner[side], kGrassM), corner(a, kGrassM),
                          corner(b, kGrassM));
            const size_t hill = side * static_cast<size_t>(hills) + static_cast<size_t>(i);
            const float heightA = hillM[hill], heightB = hillM[(hill + 1) % hillM.size()];
            const auto top = [](glm::vec2 p, float height) {
                return Corner{above(1.3f * p, height), 1.3f * p / kGrassM};
            };
            mesh.quad(CityMaterial::grass, corner(b, kGrassM), corner(a, kGrassM), top(a, heightA),
                      top(b, heightB));
        }
    }
}

// Adds something, unless the mesh would then have more triangles than the limit.
template <class Add>
bool addWithin(MeshBuilder& mesh, size_t limit, Add add) {
    const MeshBuilder::Mark mark = mesh.mark();
    add();
    if (mesh.triangleCount() <= limit) return true;
    mesh.rollBack(mark);
    return false;
}

void addBuildings(MeshBuilder& mesh, const Block& block, size_t limit) {
    constexpr std::array kDetails{Detail::full, Detail::plain};
    const auto addBest = [&](auto add) {
        std::any_of(kDetails.begin(), kDetails.end(),
                    [&](Detail detail) { return addWithin(mesh, limit, [&] { add(detail); }); });
    };
    uint64_t key = block.key + 100;
    switch (block.kind) {
        case BlockKind::houses:
            for (const House& house : planHouses(block))
                addBest([&, houseKey = ++key](Detail detail) {
                    addHouse(mesh, house, detail, Random(houseKey));
                });
            break;
        case BlockKind::towers:
            for (const Lot& lot : planTowers(block))
                addBest(
                    [&, towerKey = ++key](Detail detail) { addTower(mesh, lot, detail, Random(towerKey)); });
            break;
        case BlockKind::park:
            addWithin(mesh, limit, [&] { addLawn(mesh, block.buildable()); });
            break;
    }
}

// The last few triangles are fallen leaves on the sidewalks, some around every block.
void addLeaves(MeshBuilder& mesh, const std::vector<Block>& blocks, size_t target, uint32_t seed) {
    Random random(keyFrom(seed, KeyPurpose::leaves, 0, 0));
    for (size_t i = 0; mesh.triangleCount() < target; ++i) {
        const Lot kerb = blocks[i % blocks.size()].kerb;
        const bool alongX = random.chance(0.5f), atLow = random.chance(0.5f);
        const float across = random.between(0.4f, kSidewalkM - 0.4f);
        const glm::vec2 edge = atLow ? kerb.lowM + across : kerb.highM - across;
        const glm::vec2 place = alongX ? glm::vec2(random.between(kerb.lowM.x + 2, kerb.highM.x - 2), edge.y)
                                       : glm::vec2(edge.x, random.between(kerb.lowM.y + 2, kerb.highM.y - 2));
        addLeaf(mesh, above(place, kSidewalkHeightM), random);
    }
}

}  // namespace

Scene makeCity(uint32_t triangles, uint32_t seed) {
    Scene scene;
    scene.name = "city";
    scene.defaultCamera.positionM = {0, 8, 0};
    addCityMaterials(scene);

    const StreetGrid grid = planStreets(triangles, seed);
    const std::vector<Block> blocks = planBlocks(grid, seed);
    MeshBuilder mesh(triangles);
    addGround(mesh, grid, triangles, seed);
    for (const Block& block : blocks) addSidewalk(mesh, block);

    // Every block gets a share of what the blocks before it left over. Buildings come before streets; they
    // may take twice an equal share, because those of one block differ much from those of the next. Streets
    // get more of it near the crossing, where they are seen best.
    const auto shareOf = [&](size_t total, size_t block) {
        return total <= mesh.triangleCount() ? 0 : (total - mesh.triangleCount()) / (blocks.size() - block);
    };
    const size_t buildingTriangles = static_cast<size_t>(kBuildingShare * static_cast<float>(triangles));
    for (size_t i = 0; i < blocks.size(); ++i)
        addBuildings(mesh, blocks[i],
                     std::min(mesh.triangleCount() + 2 * shareOf(buildingTriangles, i), buildingTriangles));
    for (size_t i = 0; i < blocks.size(); ++i) {
        const size_t limit =
            std::min(mesh.triangleCount() + 8 * shareOf(triangles, i) / 5, size_t{triangles});
        for (const StreetItem& add : planStreetItems(blocks[i])) addWithin(mesh, limit, [&] { add(mesh); });
    }
    addLeaves(mesh, blocks, triangles, seed);

    mesh.moveInto(scene);
    return scene;
}

}  // namespace curvewall
