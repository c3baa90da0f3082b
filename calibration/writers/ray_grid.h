#pragma once
// What a display sees at the nodes of a grid, and the simplest pictures that hold all of that.

#include "calibration/projections/frustum.h"
#include "calibration/projections/grid_layout.h"
#include "calibration/projections/pose.h"
#include "calibration/wall.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>
#include <vector>

namespace curvewall {

struct RayGrid {
    glm::ivec2 nodes{0};
    Alignment alignment = Alignment::centers;
    std::vector<glm::dvec3> rays;  // row by row from the top, as unproject gives them; NaN in holes

    glm::dvec2 positionPx(glm::ivec2 node, glm::ivec2 sizePx) const;
};

// The pixel centres without `nodes`, else a grid from border to border. At least 2 x 2 nodes, and a ray at
// one of them: throws UsageError for a display that is too small or shows nothing there.
RayGrid rayGrid(const Display& display, std::optional<glm::ivec2> nodes);

// A cone around all rays, as narrow as a few candidates for its axis allow, with a frame whose -z is the axis
// and whose x is where the display's columns lead.
struct ViewCone {
    Orientation orientation;
    double halfAngleRad = 0;
};
ViewCone viewCone(const RayGrid& grid);

// What a plane can hold with accuracy: 85 degrees to each side.
bool fitsFrustum(const ViewCone& cone);
// The frustum of the cone's frame that just holds the rays; they fit one.
Frustum frustumAround(const RayGrid& grid, const ViewCone& cone);

}  // namespace curvewall
