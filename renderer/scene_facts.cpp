#include "renderer/scene_facts.h"

#include "calibration/angles.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace curvewall {
namespace {

using Corners = std::array<glm::dvec3, 3>;

// Van Oosterom and Strackee, The Solid Angle of a Plane Triangle, 1983, for corners at distance one.
double solidAngleOf(const Corners& units) {
    const auto& [a, b, c] = units;
    const double volume = std::abs(glm::dot(a, glm::cross(b, c)));
    return 2 * std::atan2(volume, 1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
}

// The share of some places on a triangle that the cone holds.
double shareInCone(const Corners& rays, const DisplayFacts& display) {
    constexpr int kSteps = 6;
    const double leastCosine = std::cos(display.reachRad);
    int inside = 0, all = 0;
    for (int i = 0; i <= kSteps; ++i)
        for (int j = 0; i + j <= kSteps; ++j, ++all) {
            const double a = static_cast<double>(i) / kSteps, b = static_cast<double>(j) / kSteps;
            const glm::dvec3 ray = a * rays[0] + b * rays[1] + (1 - a - b) * rays[2];
            if (glm::dot(ray, display.axis) >= leastCosine * glm::length(ray)) ++inside;
        }
    return static_cast<double>(inside) / all;
}

}  // namespace

SceneFacts factsOf(const Scene& scene, const SceneView& view, const DisplayFacts& display) {
    constexpr size_t kMostTriangles = 200'000;
    SceneFacts facts;
    facts.triangles = static_cast<double>(scene.triangles.size());
    if (scene.triangles.empty() || display.shownPx <= 0 || display.solidAngleSr <= 0) return facts;
    const size_t every = (scene.triangles.size() + kMostTriangles - 1) / kMostTriangles;
    const double pxPerRad = std::sqrt(display.shownPx / display.solidAngleSr);
    const bool seesAll = display.reachRad >= std::numbers::pi;
    double seenSr = 0;
    for (size_t i = 0; i < scene.triangles.size(); i += every) {
        Corners rays, units;
        for (glm::length_t corner = 0; corner < 3; ++corner) {
            const auto index = static_cast<size_t>(corner);
            rays[index] = glm::dvec3(view.wallFromScene *
                                     (scene.positions[scene.triangles[i][corner]] + view.originFromEyeM));
            units[index] = rays[index] / std::max(glm::length(rays[index]), 1e-30);
        }
        const double share = seesAll ? 1 : shareInCone(rays, display);
        if (share <= 0) continue;
        const double edge =
            pxPerRad * std::max({angleBetween(units[0], units[1]), angleBetween(units[1], units[2]),
                                 angleBetween(units[2], units[0])});
        facts.seenTriangles += 1;
        facts.squaredEdgesPx2 += share * edge * edge;
        facts.longestEdgePx = std::max(facts.longestEdgePx, edge);
        seenSr += share * solidAngleOf(units);
    }
    facts.seenTriangles *= static_cast<double>(every);
    facts.squaredEdgesPx2 *= static_cast<double>(every);
    // What the cone holds beside the display is not drawn.
    const double coneSr = 2 * std::numbers::pi * (1 - std::cos(display.reachRad));
    facts.fragmentsAPixel = static_cast<double>(every) * seenSr / std::max(coneSr, display.solidAngleSr);
    return facts;
}

}  // namespace curvewall
