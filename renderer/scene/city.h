#pragma once
// The built-in scene `city`, after the test scene of Lorenz and Doellner (Real-time Piecewise Perspective
// Projections, 2009): a textured city of 35,000 triangles in 14 materials, seen from a street crossing.

#include "renderer/scene/scene.h"

#include <cstdint>

namespace curvewall {

inline constexpr uint32_t kMinCityTriangles = 1'000;
inline constexpr uint32_t kMaxCityTriangles = 5'000'000;
inline constexpr uint32_t kDefaultCityTriangles = 35'000;

// Exactly `triangles` triangles, the same ones for the same numbers on every machine. The ground is y = 0,
// the origin lies on a crossing. More triangles make a larger city, not finer houses.
Scene makeCity(uint32_t triangles = kDefaultCityTriangles, uint32_t seed = 1);

}  // namespace curvewall
