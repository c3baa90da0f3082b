#include "tests/renderer/bounding_shape.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace curvewall::test {
namespace {

double turn(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Twice that of a convex polygon, positive if counter-clockwise.
double areaOf(std::span<const glm::dvec2> corners) {
    double area = 0;
    for (size_t i = 2; i < corners.size(); ++i) area += turn(corners[0], corners[i - 1], corners[i]);
    return area;
}

// By how much it leaves a place outside.
double missOf(std::span<const glm::dvec2> corners, glm::dvec2 place) {
    const double area = areaOf(corners);
    if (!(std::abs(area) > 0)) return std::numeric_limits<double>::infinity();
    double worst = -std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 from = corners[i], to = corners[(i + 1) % corners.size()];
        const double length = glm::length(to - from);
        if (length > 0) worst = std::max(worst, (area < 0 ? 1 : -1) * turn(from, to, place) / length);
    }
    return worst;
}

std::vector<std::span<const glm::dvec2>> partsOf(const BoundingShape& shape) {
    const size_t size = isQuad(shape.kind) ? 4 : 3;
    std::vector<std::span<const glm::dvec2>> parts;
    for (size_t i = 0; i + size <= shape.corners.size(); i += size)
        parts.push_back(std::span(shape.corners).subspan(i, size));
    return parts;
}

// Those that hold what is seen in this direction.
std::vector<std::span<const glm::dvec2>> partsOf(const BoundingShape& shape, glm::dvec3 direction) {
    std::vector<std::span<const glm::dvec2>> parts = partsOf(shape);
    if (isQuad(shape.kind)) return parts;
    const auto middle = parts.begin() + shape.before;
    return glm::dot(shape.cut, direction) >= 0 ? std::vector(parts.begin(), middle)
                                               : std::vector(middle, parts.end());
}

}  // namespace

double areaOf(const BoundingShape& shape) {
    double area = 0;
    for (const auto part : partsOf(shape)) area += std::abs(areaOf(part)) / 2;
    return area;
}

double missOf(const BoundingShape& shape, glm::dvec3 direction, glm::dvec2 place) {
    double miss = std::numeric_limits<double>::infinity();
    for (const auto part : partsOf(shape, direction)) miss = std::min(miss, missOf(part, place));
    return miss;
}

int timesCovered(const BoundingShape& shape, glm::dvec3 direction, glm::dvec2 place, double depth) {
    return static_cast<int>(std::ranges::count_if(
        partsOf(shape, direction), [&](const auto part) { return missOf(part, place) < -depth; }));
}

}  // namespace curvewall::test
