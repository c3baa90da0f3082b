#pragma once
// The formulas of shaders/projections/ for C++, in double precision. GLSL compiles the same files with
// `real` as float.

#include <glm/glm.hpp>

namespace curvewall::maths {

using real = double;
using real2 = glm::dvec2;
using real3 = glm::dvec3;
using real4 = glm::dvec4;
using real3x3 = glm::dmat3;

// The names that the formulas use, as GLSL has them.
using glm::abs, glm::acos, glm::asin, glm::atan, glm::cos, glm::cross, glm::dot, glm::floor, glm::length,
    glm::max, glm::min, glm::mix, glm::normalize, glm::sin, glm::sqrt, glm::tan;

#define SHARED_FN inline
#include "shaders/projections/root_ahead.glsl"
// What is above is needed by what is below.
#include "shaders/projections/bilinear.glsl"
#include "shaders/projections/cylinder.glsl"
#include "shaders/projections/equirectangular.glsl"
#include "shaders/projections/pinhole.glsl"
#include "shaders/projections/radial.glsl"
#include "shaders/projections/sphere.glsl"
#include "shaders/projections/sphere_slices.glsl"
#undef SHARED_FN

}  // namespace curvewall::maths
