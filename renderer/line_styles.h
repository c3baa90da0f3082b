#pragma once
// The formulas of shaders/line_styles.glsl for C++.

#include <glm/glm.hpp>

namespace curvewall::line_styles {

using glm::abs, glm::clamp, glm::dot, glm::fract, glm::length, glm::max, glm::min, glm::mix, glm::sqrt,
    glm::vec2, glm::vec3;
#define SHARED_FN inline
#include "shaders/line_styles.glsl"
#undef SHARED_FN

}  // namespace curvewall::line_styles
