#pragma once
// shaders/bounding_shapes.glsl in single precision, as GLSL computes it.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <vector>

namespace curvewall::test {

struct SingleShape {
    std::vector<glm::dvec2> corners;
    int before = 0;
    glm::dvec3 cut{0};
};

struct SingleLens {
    int model = 0;
    std::array<float, 9> coefficients{};
    float edge = 0;
};

using SingleTriangle = std::array<glm::vec3, 3>;

SingleShape singleTriangleBounds(const SingleLens& lens, float margin, const SingleTriangle& triangle);
SingleShape singleQuadBounds(const SingleLens& lens, float margin, const SingleTriangle& triangle);
SingleShape singleRingBounds(const SingleLens& lens, float margin, const SingleTriangle& triangle);

}  // namespace curvewall::test
