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

test::BoundingShape shapeOf(test::ShapeKind kind, const BoundingTriangles& triangles) {
    test::BoundingShape shape{kind, {}, triangles.before, glm::dvec3(triangles.cut)};
    shape.corners.assign(triangles.corners, triangles.corners + 3 * triangles.count);
    return shape;
}

test::BoundingShape shapeOf(test::ShapeKind kind, const BoundingQuad& quad) {
    test::BoundingShape shape{kind, {}};
    shape.corners.assign(quad.corners, quad.corners + 4 * quad.count);
    return shape;
}

}  // namespace
}  // namespace curvewall::single

namespace curvewall::test {

BoundingShape boundsInSingle(ShapeKind kind, const SingleLens& lens, float margin,
                             const std::array<glm::vec3, 3>& triangle) {
    const auto& [a, b, c] = triangle;
    const float* terms = lens.coefficients.data();
    if (isQuad(kind)) {
        const auto bounds = kind == ShapeKind::quad ? single::quadBounds : single::genericBounds;
        return single::shapeOf(kind, bounds(lens.model, terms, lens.edge, margin, a, b, c));
    }
    const auto bounds = kind == ShapeKind::ring ? single::ringBounds : single::triangleBounds;
    return single::shapeOf(kind, bounds(lens.model, terms, lens.edge, margin, a, b, c));
}

}  // namespace curvewall::test
