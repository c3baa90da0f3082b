#pragma once
// A shape around the picture of a triangle, as shaders/bounding_shapes.glsl gives it in any language.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <vector>

namespace curvewall::test {

enum class ShapeKind { triangle, quad, genericQuad, ring };

inline bool isQuad(ShapeKind kind) { return kind == ShapeKind::quad || kind == ShapeKind::genericQuad; }

struct BoundingShape {
    ShapeKind kind = ShapeKind::triangle;
    std::vector<glm::dvec2> corners;  // of a quad, or of triangles
    int before = 0;                   // as in BoundingTriangles
    glm::dvec3 cut{0};
};

double areaOf(const BoundingShape& shape);

// By how much the shape misses the place of a direction; at most 0 if it does not.
double missOf(const BoundingShape& shape, glm::dvec3 direction, glm::dvec2 place);

// In how many of its parts a place is, further inside than `depth`.
int timesCovered(const BoundingShape& shape, glm::dvec3 direction, glm::dvec2 place, double depth);

}  // namespace curvewall::test
