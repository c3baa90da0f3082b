// Compiled with constants of single precision: the formulas mix them with `real`. Nothing here may share
// inline functions with double precision code.

#include "tests/renderer/bounding_shapes_single.h"

#include <glm/glm.hpp>

namespace curvewall::single {

using real = float;
using real2 = glm::vec2;
using real3 = glm::vec3;

using glm::abs, glm::atan, glm::clamp, glm::cos, glm::cross, glm::dot, glm::length, glm::max, glm::min,
    glm::normalize, glm::pow, glm::sin, glm::sqrt, glm::tan;

namespace {

#define SHARED_FN [[maybe_unused]] inline
#include "shaders/projections/radial.glsl"
// What is above is needed by what is below.
#include "shaders/bounding_shapes.glsl"
#undef SHARED_FN

test::SingleShape shapeOf(const BoundingTriangles& triangles) {
    test::SingleShape shape{{}, triangles.before, glm::dvec3(triangles.cut)};
    shape.corners.assign(triangles.corners, triangles.corners + 3 * triangles.count);
    return shape;
}

}  // namespace
}  // namespace curvewall::single

namespace curvewall::test {

SingleShape singleTriangleBounds(const SingleLens& lens, float margin, const SingleTriangle& triangle) {
    return single::shapeOf(single::triangleBounds(lens.model, lens.coefficients.data(), lens.edge, margin,
                                                  triangle[0], triangle[1], triangle[2]));
}

SingleShape singleQuadBounds(const SingleLens& lens, float margin, const SingleTriangle& triangle) {
    const auto quad = single::quadBounds(lens.model, lens.coefficients.data(), lens.edge, margin, triangle[0],
                                         triangle[1], triangle[2]);
    SingleShape shape;
    shape.corners.assign(quad.corners, quad.corners + 4 * quad.count);
    return shape;
}

SingleShape singleRingBounds(const SingleLens& lens, float margin, const SingleTriangle& triangle) {
    return single::shapeOf(single::ringBounds(lens.model, lens.coefficients.data(), lens.edge, margin,
                                              triangle[0], triangle[1], triangle[2]));
}

}  // namespace curvewall::test
