#pragma once
// Scenes with textures, points and lines whose looks are known in closed form.

#include "renderer/scene/scene_building.h"

#include <glm/glm.hpp>

#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace curvewall {

// `level(k)` gives the texels of level k of a full chain.
template <class Level>
Texture squareTexture(int sizePx, Level texelsOfLevel) {
    Texture texture;
    for (int size = sizePx, level = 0; size >= 1; size /= 2, ++level)
        texture.levels.push_back({{size, size}, texelsOfLevel(level, size)});
    return texture;
}

// Every level one grey: what is seen tells which level was sampled.
inline Texture levelsTexture(int sizePx, const std::vector<uint8_t>& greyOfLevel) {
    return squareTexture(sizePx, [&](int level, int size) {
        const uint8_t grey = greyOfLevel.at(static_cast<size_t>(level));
        return std::vector<glm::u8vec4>(static_cast<size_t>(size * size), glm::u8vec4(grey, grey, grey, 255));
    });
}

inline Material texturedMaterial(Scene& scene, Texture texture) {
    Material material = plainMaterial(glm::vec3(1));
    material.texture = static_cast<int>(scene.textures.size());
    material.unlit = true;
    scene.textures.push_back(std::move(texture));
    return material;
}

// A square ahead whose right half an alpha mask takes away.
inline Scene maskedSquare() {
    Scene scene;
    Texture stripes = squareTexture(8, [](int, int size) {
        std::vector<glm::u8vec4> texels;
        for (int i = 0; i < size * size; ++i)
            texels.emplace_back(200, 60, 20, size > 1 && i % size < size / 2 ? 255 : 0);
        return texels;
    });
    stripes.levels.resize(1);
    Material material = texturedMaterial(scene, stripes);
    material.alphaCutoff = 0.5f;
    startMaterial(scene, material);
    addFrontalSquare(scene, {0, 0, -2}, 4);
    return scene;
}

inline uint32_t addVertex(Scene& scene, glm::vec3 position, glm::vec2 uv = {}, glm::vec3 normal = {0, 1, 0}) {
    scene.positions.push_back(position);
    scene.normals.push_back(normal);
    scene.uvs.push_back(uv);
    return static_cast<uint32_t>(scene.positions.size()) - 1;
}

// Points and lines with a material of their own.
inline void addPoints(Scene& scene, const Material& material, const std::vector<glm::vec3>& positions) {
    scene.pointRanges.push_back({static_cast<uint32_t>(scene.materials.size()),
                                 static_cast<uint32_t>(scene.points.size()),
                                 static_cast<uint32_t>(positions.size())});
    scene.materials.push_back(material);
    for (const glm::vec3 position : positions) scene.points.push_back(addVertex(scene, position));
}

inline void addLines(Scene& scene, const Material& material,
                     const std::vector<std::array<glm::vec3, 2>>& lines) {
    scene.lineRanges.push_back({static_cast<uint32_t>(scene.materials.size()),
                                static_cast<uint32_t>(scene.lines.size()),
                                static_cast<uint32_t>(lines.size())});
    scene.materials.push_back(material);
    for (const auto& [from, to] : lines) {
        const uint32_t first = addVertex(scene, from, {0, 0});
        scene.lines.emplace_back(first, addVertex(scene, to, {1, 0}));
    }
}

}  // namespace curvewall
