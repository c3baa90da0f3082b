#pragma once
// Where in a cell between four corners a value lies.

#include "calibration/projections/projection_maths.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>

namespace curvewall {

// A triangle is the half of a cell where s + t <= 1.
enum class CellShape { quadrilateral, triangle };

// The point of the cell nearest to st, which lies in it or beside it.
inline glm::dvec2 clampedToCell(glm::dvec2 st, CellShape shape) {
    st = glm::clamp(st, 0.0, 1.0);
    return shape == CellShape::triangle && st.x + st.y > 1 ? st / (st.x + st.y) : st;
}

// Calls found(st) for every point of the cell that has the value to within `slack` (in units of the value).
// Points just outside count as those on the border: an edge that two cells share is never lost between them.
template <class Found>
void solveCell(const maths::BilinearCell& cell, CellShape shape, glm::dvec2 value, double slack,
               const Found& found) {
    const maths::BilinearRoots roots = maths::bilinearInverse(cell, value);
    for (const glm::dvec2 st : {roots.first, roots.second}) {
        if (!(st.x > -1 && st.x < 2 && st.y > -1 && st.y < 2)) continue;  // not a number either
        const glm::dvec2 inside = clampedToCell(st, shape);
        const glm::dvec2 off = glm::abs(maths::bilinearAt(cell, inside) - value);
        if (std::max(off.x, off.y) <= slack) found(inside);
    }
}

// Twice the area that two sides span.
inline double spannedArea(glm::dvec2 a, glm::dvec2 b) { return std::abs(maths::cross2(a, b)); }
inline double spannedArea(glm::dvec3 a, glm::dvec3 b) { return glm::length(glm::cross(a, b)); }

inline double largestCoordinate(glm::dvec2 a) { return std::max(std::abs(a.x), std::abs(a.y)); }
inline double largestCoordinate(glm::dvec3 a) {
    return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}

// Whether the cell is more than a line or a point, for corners that are good to `noise` (an absolute length).
template <class Vector>
bool spansArea(Vector v00, Vector v10, Vector v01, Vector v11, double noise) {
    const Vector bottom = v10 - v00, left = v01 - v00, top = v11 - v01, right = v11 - v10;
    const double area = std::max({spannedArea(bottom, left), spannedArea(bottom, right),
                                  spannedArea(top, left), spannedArea(top, right)});
    const double extent = std::max(
        {glm::dot(bottom, bottom), glm::dot(left, left), glm::dot(top, top), glm::dot(right, right)});
    return area * area > noise * noise * extent;
}

// A cell with a corner that is no sample (its x is not a number), or that is no more than a line for values
// of single precision.
template <class Vector>
bool isHoleCell(Vector v00, Vector v10, Vector v01, Vector v11) {
    constexpr double kFloatRounding = 0x1.0p-22;  // of the numbers in a file
    if (std::isnan(v00.x + v10.x + v01.x + v11.x)) return true;
    const double noise = kFloatRounding * std::max({largestCoordinate(v00), largestCoordinate(v10),
                                                    largestCoordinate(v01), largestCoordinate(v11)});
    return !spansArea(v00, v10, v01, v11, noise);
}

}  // namespace curvewall
