#pragma once
// Where a display shows what lies in a direction, sampled over a chart of directions in double precision: the
// camera texture of the vertex shaders that Lorenz and Doellner (2009) cite in section 1.1, for any
// projection.

#include "calibration/pieces/pixel_rays.h"
#include "calibration/wall.h"

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include <vector>

namespace curvewall {

// Directions about an axis, as positions in a plane.
struct DirectionChart {
    glm::dmat3 chartFromWall{1};  // a rotation; the axis becomes -z
    bool isPlane = false;         // the plane one unit ahead; otherwise the angle off the axis is the radius

    glm::dvec2 position(glm::dvec3 ray) const;
    glm::dvec3 direction(glm::dvec2 position) const;  // wall axes
};

// About an axis of length one.
glm::dmat3 chartFromWallAbout(glm::dvec3 axis);

struct PositionTable {
    DirectionChart chart{};
    glm::dvec2 least{0};         // of the chart, at the first node
    glm::dvec2 nodesPerUnit{1};  // of the chart
    glm::ivec2 nodes{0};
    std::vector<glm::dvec2> px{};  // row by row; where the display ends they go on outwards
    glm::dmat2 pxFromChart{1};     // how positions go on beside the table, on the whole

    glm::dvec2 at(glm::dvec3 ray) const;
};

// Throws UsageError where the display shows directions at several places, or tears its picture.
PositionTable samplePositions(const Display& display, const PixelRays& rays, const DirectionChart& chart);

}  // namespace curvewall
