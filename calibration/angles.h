#pragma once
// Angles between directions.

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>

namespace curvewall {

// In radians, 0 to pi; exact for small ones too, which the cosine cannot tell apart.
inline double angleBetween(glm::dvec3 a, glm::dvec3 b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace curvewall
