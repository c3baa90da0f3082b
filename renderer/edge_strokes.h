#pragma once
// Lines along edges as the reference draws them: from exact rays, one sample at a time.

#include "calibration/projections/projection.h"
#include "renderer/edge_neighbours.h"
#include "renderer/look.h"
#include "renderer/scene/scene.h"

#include <glm/mat3x3.hpp>

#include <vector>

namespace curvewall {

class EdgeStrokes {
public:
    // The scene must outlive it.
    EdgeStrokes(const Scene& scene, Style style);

    struct Eye {
        const Projection& projection;
        const glm::dmat3& sceneFromWall;
        glm::dvec3 positionM;  // relative to the scene's origin
        double footprintPx;    // side of the square that one sample stands for
    };

    // Share of the sample at `px` that the lines along this triangle's edges cover.
    float coverage(uint32_t triangle, const Eye& eye, glm::dvec2 px) const;

private:
    float widthPx(uint32_t triangle, int edge, glm::dvec3 edgePlane, glm::dvec3 eyeM) const;

    const Scene& scene_;
    Style style_;
    std::vector<EdgeNeighbour> neighbours_;
};

}  // namespace curvewall
