#pragma once
// The shapes of shaders/bounding_shapes.glsl for C++, in double precision.

#include "calibration/projections/projection_maths.h"

namespace curvewall::maths {

using glm::clamp, glm::pow;

#define SHARED_FN inline
#include "shaders/bounding_shapes.glsl"
#undef SHARED_FN

}  // namespace curvewall::maths
