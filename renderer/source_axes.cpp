#include "renderer/source_axes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace curvewall {

std::vector<glm::ivec2> latticeOf(glm::ivec2 sizePx, glm::ivec2 counts) {
    counts = glm::min(counts, sizePx);
    std::vector<glm::ivec2> pixels;
    for (int row = 0; row < counts.y; ++row)
        for (int column = 0; column < counts.x; ++column)
            pixels.push_back(glm::ivec2(column, row) * (sizePx - 1) / glm::max(counts - 1, 1));
    return pixels;
}

std::vector<glm::dvec3> directionsOf(const PixelRays& rays, const std::vector<glm::ivec2>& pixels) {
    std::vector<glm::dvec3> directions;
    for (const glm::ivec2 px : pixels)
        if (const glm::dvec3 ray = rays.at(px); PixelRays::isRay(ray))
            directions.push_back(glm::normalize(ray));
    return directions;
}

// By steps towards the farthest (Badoiu and Clarkson, Smaller core-sets for balls, 2003).
glm::dvec3 axisOf(const std::vector<glm::dvec3>& directions) {
    constexpr int kSteps = 2000;
    glm::dvec3 axis = directions.front();
    for (int step = 1; step <= kSteps; ++step) {
        const auto farthest = std::ranges::min_element(
            directions, {}, [&](const glm::dvec3& direction) { return glm::dot(axis, direction); });
        axis += (*farthest - axis) / (step + 1.0);
    }
    return axis;
}

FaceAxes axesAround(glm::dvec3 ahead, glm::dvec3 right) {
    FaceAxes axes{{}, {}, glm::normalize(ahead)};
    axes.right = glm::normalize(right - glm::dot(right, axes.ahead) * axes.ahead);
    axes.down = glm::cross(axes.ahead, axes.right);
    return axes;
}

glm::dvec3 aside(glm::dvec3 direction) {
    return std::abs(direction.x) < 0.7 * glm::length(direction) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1);
}

FaceAxes turned(const FaceAxes& axes, TurnAround around, double angleRad) {
    const double c = std::cos(angleRad), s = std::sin(angleRad);
    switch (around) {
        case TurnAround::down:
            return axesAround(c * axes.ahead + s * axes.right, c * axes.right - s * axes.ahead);
        case TurnAround::right:
            return axesAround(c * axes.ahead + s * axes.down, axes.right);
        case TurnAround::ahead:
            break;
    }
    return axesAround(axes.ahead, c * axes.right + s * axes.down);
}

}  // namespace curvewall
