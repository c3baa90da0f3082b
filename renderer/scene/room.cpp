#include "renderer/scene/room.h"

#include <glm/geometric.hpp>

#include <array>

namespace curvewall {
namespace {

struct RoomWall {
    const char* name;
    glm::vec3 outward;
    glm::vec4 color;
};

constexpr std::array<RoomWall, 6> kRoomWalls{{
    {"left", {-1, 0, 0}, {0.60f, 0.09f, 0.07f, 1}},
    {"right", {1, 0, 0}, {0.08f, 0.36f, 0.12f, 1}},
    {"floor", {0, -1, 0}, {0.26f, 0.19f, 0.12f, 1}},
    {"ceiling", {0, 1, 0}, {0.72f, 0.72f, 0.68f, 1}},
    {"front", {0, 0, -1}, {0.10f, 0.22f, 0.56f, 1}},
    {"back", {0, 0, 1}, {0.66f, 0.48f, 0.08f, 1}},
}};

}  // namespace

Scene makeRoom() {
    Scene scene;
    scene.name = "room";
    for (const RoomWall& wall : kRoomWalls) {
        const auto material = static_cast<uint32_t>(scene.materials.size());
        Material color;
        color.name = wall.name;
        color.baseColor = wall.color;
        scene.materials.push_back(color);

        // right x up points back into the room, so the corners run counter-clockwise seen from inside.
        const glm::vec3 up = wall.outward.y != 0 ? glm::vec3(0, 0, wall.outward.y) : glm::vec3(0, 1, 0);
        const glm::vec3 right = glm::cross(wall.outward, up);
        const auto first = static_cast<uint32_t>(scene.positions.size());
        for (const glm::vec2 corner :
             {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
            // Every coordinate is plus or minus half the size, so that corners are the same bits in all
            // walls.
            scene.positions.push_back((wall.outward + corner.x * right + corner.y * up) *
                                      (0.5f * kRoomSizeM));
            scene.normals.push_back(-wall.outward);
            scene.uvs.emplace_back(0.5f + 0.5f * corner.x, 0.5f - 0.5f * corner.y);
        }
        scene.ranges.push_back({material, static_cast<uint32_t>(scene.triangles.size()), 2});
        scene.triangles.emplace_back(first, first + 1, first + 2);
        scene.triangles.emplace_back(first, first + 2, first + 3);
    }
    return scene;
}

}  // namespace curvewall
