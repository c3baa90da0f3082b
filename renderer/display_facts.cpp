#include "renderer/display_facts.h"

#include "renderer/shown_error.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace curvewall {
namespace {

constexpr int kPlaces = 64;  // along the longer side

struct Place {
    glm::dvec2 px;
    glm::dvec3 ray;  // of length one
};

std::optional<glm::dvec3> rayAt(const Display& display, glm::dvec2 px) {
    const auto ray = display.projection->unproject(px);
    if (!ray) return std::nullopt;
    const glm::dvec3 unit = glm::normalize(*ray);
    return std::isfinite(unit.x + unit.y + unit.z) ? std::optional(unit) : std::nullopt;
}

double stepPx(const Display& display) {
    return std::max(static_cast<double>(std::max(display.sizePx.x, display.sizePx.y)) / kPlaces, 1.0);
}

// The middles of cells that cover the display.
std::vector<Place> placesOn(const Display& display) {
    std::vector<Place> places;
    const glm::ivec2 count = glm::ceil(glm::dvec2(display.sizePx) / stepPx(display));
    for (int y = 0; y < count.y; ++y)
        for (int x = 0; x < count.x; ++x) {
            const glm::dvec2 px = (glm::dvec2(x, y) + 0.5) / glm::dvec2(count) * glm::dvec2(display.sizePx);
            if (const auto ray = rayAt(display, px)) places.push_back({px, *ray});
        }
    return places;
}

// The solid angle of the pixel around a place.
double solidAngleAt(const Display& display, const Place& place) {
    const auto right = rayAt(display, place.px + glm::dvec2(0.5, 0)),
               left = rayAt(display, place.px - glm::dvec2(0.5, 0)),
               below = rayAt(display, place.px + glm::dvec2(0, 0.5)),
               above = rayAt(display, place.px - glm::dvec2(0, 0.5));
    if (!right || !left || !below || !above) return 0;
    return glm::length(glm::cross(*right - *left, *below - *above));
}

// A straight stroke shows, at its middle, the middle of the two rays at its ends.
double bendAt(const Display& display, const PixelDistance& distance, const Place& place, double halfPx) {
    double most = 0;
    constexpr double kDiagonal = std::numbers::sqrt2 / 2;
    for (const glm::dvec2 way :
         {glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(kDiagonal, kDiagonal), {kDiagonal, -kDiagonal}}) {
        const auto from = rayAt(display, place.px - halfPx * way),
                   to = rayAt(display, place.px + halfPx * way);
        if (!from || !to) continue;
        const auto off = distance.from(place.px, *from + *to);
        most = std::max(most, off.value_or(std::numeric_limits<double>::infinity()));
    }
    return most / (4 * halfPx * halfPx);
}

}  // namespace

DisplayFacts factsOf(const Display& display) {
    DisplayFacts facts;
    const std::vector<Place> places = placesOn(display);
    if (places.empty()) return facts;
    const double step = stepPx(display);
    const glm::dvec2 cellPx = glm::dvec2(display.sizePx) / glm::ceil(glm::dvec2(display.sizePx) / step);
    const PixelDistance distance(display);
    glm::dvec3 sum(0);
    double ofPixels = 0;
    for (const Place& place : places) {
        sum += place.ray;
        ofPixels += solidAngleAt(display, place);
        facts.bendPx = std::max(facts.bendPx, bendAt(display, distance, place, step / 2));
    }
    facts.shownPx = static_cast<double>(places.size()) * cellPx.x * cellPx.y;
    facts.solidAngleSr = ofPixels * cellPx.x * cellPx.y;
    constexpr double kNoMiddle = 1e-3;  // of the number of places
    if (glm::length(sum) < kNoMiddle * static_cast<double>(places.size())) {
        facts.reachRad = std::numbers::pi;
        return facts;
    }
    facts.axis = glm::normalize(sum);
    double leastCosine = 1;
    for (const Place& place : places) leastCosine = std::min(leastCosine, glm::dot(place.ray, facts.axis));
    // What lies between two places, and beyond the last one, is as far off as a step at most.
    const double aStep = step * std::sqrt(facts.solidAngleSr / facts.shownPx);
    facts.reachRad = std::min(std::acos(std::clamp(leastCosine, -1.0, 1.0)) + aStep, std::numbers::pi);
    return facts;
}

double strokeErrorPx(const DisplayFacts& facts, double lengthPx) {
    return facts.bendPx * lengthPx * lengthPx;
}

}  // namespace curvewall
