#pragma once
// A display's maps over a finished picture.

#include "calibration/blending/blend.h"
#include "renderer/frame.h"

#include <glm/glm.hpp>

#include <limits>

namespace curvewall::blending {

// The formula of shaders/blending.glsl for C++.
using glm::min, glm::vec3;
#define SHARED_FN inline
#include "shaders/blending.glsl"
#undef SHARED_FN

}  // namespace curvewall::blending

namespace curvewall {

// Eight bits show no more than white; float output keeps everything.
inline float mostLight(bool linearOutput) {
    return linearOutput ? std::numeric_limits<float>::infinity() : 1.0f;
}

// Blends a colour frame in place. The maps are of its size.
void blend(Frame& frame, const BlendMaps& maps, float most);

}  // namespace curvewall
