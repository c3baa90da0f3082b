#pragma once
// A screen of any shape, measured: the point that every pixel lights, or points on a coarser grid and
// bilinear patches between them, seen from any eye.

#include "calibration/files/map_file.h"
#include "calibration/projections/grid_layout.h"
#include "calibration/projections/grid_pyramid.h"
#include "calibration/projections/projection.h"
#include "calibration/readers/projection_fields.h"

#include <glm/mat3x3.hpp>

#include <memory>
#include <optional>

namespace curvewall {

// The points as they were measured, in the unit and the frame of their file; no eye. Points that are not
// numbers, that lie in the frame's origin (within 1e-5) or farther away than 1e12 are no samples. Cells with
// such a node and cells without area are holes.
class MeasuredSurface {
public:
    struct Corners {
        glm::dvec3 v00, v10, v01, v11;
    };

    // Uses the first three channels. At least 2 x 2 points.
    MeasuredSurface(NumberMap points, bool bottomRowFirst, glm::ivec2 sizePx, Alignment alignment);

    bool hasSamples() const { return hasSamples_; }
    bool hasArea() const { return hasArea_; }  // at least one cell is no hole

    double extent() const { return extent_; }  // the largest coordinate
    const GridLayout& layout() const { return layout_; }
    const GridPyramid<3>& pyramid() const { return pyramid_; }

    // Where two lines cross. Beyond the outermost nodes of a map of centers the border cells go on straight.
    glm::dvec3 node(glm::ivec2 line) const;
    std::optional<Corners> corners(glm::ivec2 cell) const;  // nothing for a hole

private:
    glm::dvec3 sample(glm::ivec2 line) const;
    GridPyramid<3> survey();

    NumberMap points_;
    bool bottomRowFirst_;
    GridLayout layout_;
    bool hasSamples_ = false;
    bool hasArea_ = false;
    double extent_ = 0;
    GridPyramid<3> pyramid_;  // last: the walk that builds it finds out the members before
};

class SurfaceMap : public Projection {
public:
    // `unitM` is the surface's unit in metres.
    SurfaceMap(std::shared_ptr<const MeasuredSurface> surface, double unitM, const Pose& pose,
               glm::dvec3 eyeM);

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override;
    std::vector<glm::dvec2> project(glm::dvec3 ray) const override;
    ProjectionPtr seenFrom(glm::dvec3 eyeM) const override;

private:
    std::shared_ptr<const MeasuredSurface> surface_;
    double unitM_;
    Pose pose_;
    glm::dmat3 wallFromSurface_;  // the rotation
    glm::dvec3 eye_;              // in the surface's frame and unit
};

}  // namespace curvewall
