#pragma once
// What the city is made of: 14 materials, and a palette for all that is painted in one plain colour.

#include "renderer/scene/scene.h"

#include <glm/vec2.hpp>

#include <cstdint>

namespace curvewall {

enum class CityMaterial : uint32_t {
    grass,
    asphalt,
    marking,
    sidewalk,
    brick,  // facades, brick to concrete: see kFacadeBays and kFacadeFloors
    plaster,
    stone,
    glass,
    concrete,
    shop,
    flatRoof,
    tiles,
    foliage,
    paint,
};
inline constexpr uint32_t kCityMaterials = 14;

// A facade texture shows 8 x 8 bays and floors. Columns 0 to 3 and 4 to 7 are two variants, so that a wall
// segment has at most 4 bays; floors repeat.
inline constexpr int kFacadeBays = 8;
inline constexpr int kFacadeFloors = 8;
inline constexpr int kFacadeVariantBays = 4;

// The swatches of the `paint` texture.
enum class Paint : uint32_t {
    white,
    lightGrey,
    grey,
    darkGrey,
    black,
    cream,
    sand,
    brown,
    darkWood,
    terracotta,
    red,
    darkRed,
    orange,
    yellow,
    green,
    darkGreen,
    teal,
    blue,
    darkBlue,
    silver,
    darkGlass,
    lamp,
    rust,
    autumn,
};
inline constexpr uint32_t kPaintColumns = 8;
inline constexpr uint32_t kPaintRows = 3;

// The middle of a swatch: constant over a triangle, so that only texture level 0 is ever used.
constexpr glm::vec2 paintUv(Paint paint) {
    const uint32_t column = static_cast<uint32_t>(paint) % kPaintColumns;
    const uint32_t row = static_cast<uint32_t>(paint) / kPaintColumns;
    return {(static_cast<float>(column) + 0.5f) / static_cast<float>(kPaintColumns),
            (static_cast<float>(row) + 0.5f) / static_cast<float>(kPaintRows)};
}

// Appends materials, in the order of CityMaterial, and their textures.
void addCityMaterials(Scene& scene);

}  // namespace curvewall
