#pragma once
// A perspective image that a measured grid of offsets distorts, or that a display samples through one.
// Source: the view deformation of Lorenz and Doellner (2009), section 3.2; theirs is the forward direction.

#include "calibration/projections/grid_map.h"
#include "calibration/projections/projection.h"

#include <memory>
#include <optional>

namespace curvewall {

enum class MapDirection {
    forward,  // the map tells where a position of the base image lands on the display
    inverse,  // the map tells which position of the base image a position of the display shows
};

// Where several rays land on one pixel, it shows the one that GridMap::frontPosition picks.
class CameraTexture : public Projection {
public:
    // `base` is what the undistorted image shows: a frustum, or any other projection. The map's positions are
    // its pixels.
    CameraTexture(std::shared_ptr<const GridMap> map, ProjectionPtr base, MapDirection direction);

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override;
    std::vector<glm::dvec2> project(glm::dvec3 ray) const override;
    bool dependsOnEye() const override { return base_->dependsOnEye(); }
    ProjectionPtr seenFrom(glm::dvec3 eyeM) const override;

    const Projection& base() const { return *base_; }

private:
    std::shared_ptr<const GridMap> map_;
    ProjectionPtr base_;
    MapDirection direction_;
};

}  // namespace curvewall
