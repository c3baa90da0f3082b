#pragma once
// The bounds of shaders/sphere_bounds.glsl for C++, in double precision.

#include "calibration/projections/projection_maths.h"

namespace curvewall::maths {

#define SHARED_FN inline
#include "shaders/sphere_bounds.glsl"
#undef SHARED_FN

}  // namespace curvewall::maths
