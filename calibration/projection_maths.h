#pragma once
// The formulas of shaders/projections/ for C++, in double precision. GLSL compiles the same files with
// `real` as float.

#include <glm/glm.hpp>

namespace curvewall::maths {

using real = double;
using real2 = glm::dvec2;
using real3 = glm::dvec3;

// The names that the formulas use, as GLSL has them.
using glm::abs, glm::acos, glm::asin, glm::atan, glm::cos, glm::cross, glm::dot, glm::floor, glm::length,
    glm::max, glm::min, glm::mix, glm::normalize, glm::sin, glm::sqrt, glm::tan;

#define SHARED_FN inline
#include "shaders/projections/bilinear.glsl"
#include "shaders/projections/cylinder.glsl"
#undef SHARED_FN

}  // namespace curvewall::maths
