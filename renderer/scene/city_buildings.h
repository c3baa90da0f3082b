#pragma once
// Houses and towers.

#include "renderer/scene/city_materials.h"
#include "renderer/scene/mesh_builder.h"
#include "renderer/scene/random.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace curvewall {

inline constexpr float kFloorHeightM = 3.2f;
inline constexpr float kSidewalkHeightM = 0.15f;  // buildings stand on it

// A rectangle on the ground; y of the vectors is the scene's z.
struct Lot {
    glm::vec2 lowM;
    glm::vec2 highM;

    glm::vec2 sizeM() const { return highM - lowM; }
    glm::vec2 middleM() const { return 0.5f * (lowM + highM); }
    Lot inset(float distanceM) const { return {lowM + distanceM, highM - distanceM}; }
};

inline glm::vec3 above(glm::vec2 groundM, float heightM) { return {groundM.x, heightM, groundM.y}; }

// `plain` leaves out everything but walls and roof, for cities of few triangles.
enum class Detail { full, plain };

enum class HouseRoof { flat, gabled };

struct House {
    Lot lot;
    int floors = 3;  // above the ground floor
    CityMaterial facade = CityMaterial::brick;
    int variant = 0;  // 0 or 1
    HouseRoof roof = HouseRoof::flat;
    bool shops = true;
};

void addHouse(MeshBuilder& mesh, const House& house, Detail detail, Random random);

// Two or three tiers, up to 60 m high.
void addTower(MeshBuilder& mesh, const Lot& lot, Detail detail, Random random);

}  // namespace curvewall
