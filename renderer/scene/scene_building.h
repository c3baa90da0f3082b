#pragma once
// Scenes small enough that what a ray sees in them is known in closed form.

#include "renderer/scene/scene.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>

namespace curvewall {

inline Material plainMaterial(glm::vec3 color) {
    Material material;
    material.baseColor = glm::vec4(color, 1);
    return material;
}

// Adds a material and makes the triangles that are added next wear it.
inline void startMaterial(Scene& scene, const Material& material) {
    scene.ranges.push_back(
        {static_cast<uint32_t>(scene.materials.size()), static_cast<uint32_t>(scene.triangles.size()), 0});
    scene.materials.push_back(material);
}

// Counter-clockwise seen from the front.
inline void addTriangle(Scene& scene, const std::array<glm::vec3, 3>& corners,
                        const std::array<glm::vec2, 3>& uvs = {}) {
    const auto first = static_cast<uint32_t>(scene.positions.size());
    const glm::vec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    scene.positions.insert(scene.positions.end(), corners.begin(), corners.end());
    scene.normals.insert(scene.normals.end(), 3, normal);
    scene.uvs.insert(scene.uvs.end(), uvs.begin(), uvs.end());
    scene.triangles.emplace_back(first, first + 1, first + 2);
    ++scene.ranges.back().triangleCount;
}

// Corners counter-clockwise seen from the front: bottom left (u = 0, v = `uvScale`), bottom right, top right,
// top left.
inline void addQuad(Scene& scene, const std::array<glm::vec3, 4>& p, float uvScale = 1) {
    const float s = uvScale;
    addTriangle(scene, {p[0], p[1], p[2]}, {glm::vec2(0, s), glm::vec2(s, s), glm::vec2(s, 0)});
    addTriangle(scene, {p[0], p[2], p[3]}, {glm::vec2(0, s), glm::vec2(s, 0), glm::vec2(0, 0)});
}

// A square that faces +z, centred on `centreM`.
inline void addFrontalSquare(Scene& scene, glm::vec3 centreM, float sideM, float uvScale = 1) {
    const float h = sideM / 2;
    addQuad(scene,
            {centreM + glm::vec3(-h, -h, 0), centreM + glm::vec3(h, -h, 0), centreM + glm::vec3(h, h, 0),
             centreM + glm::vec3(-h, h, 0)},
            uvScale);
}

// -x, +x, -y, +y, -z, +z
inline const std::array<glm::vec3, 6> kBoxRoomColors{
    glm::vec3(0.9f, 0.1f, 0.1f), glm::vec3(0.1f, 0.9f, 0.1f), glm::vec3(0.1f, 0.1f, 0.9f),
    glm::vec3(0.9f, 0.9f, 0.1f), glm::vec3(0.1f, 0.9f, 0.9f), glm::vec3(0.9f, 0.1f, 0.9f)};

// A closed box centred on the origin whose walls face inwards, each another colour.
inline Scene boxRoom(glm::vec3 sizeM) {
    Scene scene;
    scene.name = "box";
    const glm::vec3 h = sizeM / 2.0f;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            startMaterial(scene,
                          plainMaterial(kBoxRoomColors[2 * static_cast<size_t>(axis) + (side > 0 ? 1 : 0)]));
            const auto corner = [&](float right, float up) {
                glm::vec3 p(0);
                p[axis] = side * h[axis];
                p[(axis + 1) % 3] = -side * right * h[(axis + 1) % 3];
                p[(axis + 2) % 3] = up * h[(axis + 2) % 3];
                return p;
            };
            addQuad(scene, {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)});
        }
    return scene;
}

}  // namespace curvewall
