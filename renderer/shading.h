#pragma once
// The shading formula of shaders/shading.glsl for C++.

#include <glm/glm.hpp>

namespace curvewall::shading {

using glm::dot, glm::max, glm::vec3;
#define SHARED_FN inline
#include "shaders/shading.glsl"
#undef SHARED_FN

}  // namespace curvewall::shading
