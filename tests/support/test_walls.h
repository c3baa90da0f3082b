#pragma once
// Displays that many tests look at.

#include "calibration/projections/cylinder.h"
#include "calibration/projections/planar.h"
#include "calibration/wall.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <ostream>

namespace curvewall {

// GoogleTest would print the bytes, addresses among them, into the names that ctest shows.
inline void PrintTo(const Wall& wall, std::ostream* out) {
    const Display& display = wall.displays.front();
    *out << display.projectionType << ' ' << display.sizePx.x << 'x' << display.sizePx.y;
}

}  // namespace curvewall

namespace curvewall::test {

inline constexpr double kPi = std::numbers::pi;

// The wall of configs/full-cylinder.json at any size: a full turn, equal scales, 2 m from the axis.
inline CylinderWall fullCylinder(glm::ivec2 sizePx) {
    return {2.0, 2 * kPi, 2.0 * 2 * kPi * sizePx.y / sizePx.x, {}, {}};
}

inline Wall cylinderWall(const CylinderWall& cylinder, glm::dvec3 eyeM, glm::ivec2 sizePx) {
    return {"cylinder",
            eyeM,
            {},
            {{"front", sizePx, "cylinder", std::make_shared<CylinderProjection>(cylinder, eyeM, sizePx)}}};
}

inline Wall fullCylinderWall(glm::ivec2 sizePx, glm::dvec3 eyeM = {}) {
    return cylinderWall(fullCylinder(sizePx), eyeM, sizePx);
}

// A screen one metre ahead, `fovDeg` wide.
inline Wall planarWall(glm::ivec2 sizePx, double fovDeg) {
    const double x = std::tan(fovDeg * kPi / 360), y = x * sizePx.y / sizePx.x;
    const PlanarScreen screen{{-x, -y, -1}, {x, -y, -1}, {-x, y, -1}};
    return {"planar",
            {},
            {},
            {{"front", sizePx, "planar", std::make_shared<PlanarProjection>(screen, glm::dvec3(0), sizePx)}}};
}

}  // namespace curvewall::test
