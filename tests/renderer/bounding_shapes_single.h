#pragma once
// shaders/bounding_shapes.glsl in single precision, on the processor.

#include "tests/renderer/bounding_shape.h"

#include <glm/vec3.hpp>

#include <array>

namespace curvewall::test {

struct SingleLens {
    int model = 0;
    std::array<float, 9> coefficients{};
    float edge = 0;
};

BoundingShape boundsInSingle(ShapeKind kind, const SingleLens& lens, float margin,
                             const std::array<glm::vec3, 3>& triangle);

}  // namespace curvewall::test
