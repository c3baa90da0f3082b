#pragma once
// A perspective image that a measured grid of offsets distorts, or that a display samples through one.
// Source: the view deformation of Lorenz and Doellner (2009), section 3.2; theirs is the forward direction.

#include "calibration/projections/grid_map.h"
#include "calibration/projections/pose.h"
#include "calibration/projections/projection.h"

#include <glm/mat3x3.hpp>

#include <memory>
#include <optional>

namespace curvewall {

// The undistorted image, stretched over the display. It lies at infinity: eyes anywhere see it alike.
struct BaseImage {
    double leftRad = 0, rightRad = 0, downRad = 0, upRad = 0;  // angles from -z, right and up positive
    Orientation orientation;
};

enum class MapDirection {
    forward,  // the map tells where a position of the base image lands on the display
    inverse,  // the map tells which position of the base image a position of the display shows
};

// A ray ends on the plane of the base image, one unit ahead of the eye. Where several rays land on one pixel,
// it shows the one that GridMap::frontPosition picks.
class CameraTexture : public Projection {
public:
    CameraTexture(std::shared_ptr<const GridMap> map, const BaseImage& base, MapDirection direction);

    std::optional<glm::dvec3> unproject(glm::dvec2 px) const override;
    std::vector<glm::dvec2> project(glm::dvec3 ray) const override;
    bool dependsOnEye() const override { return false; }
    ProjectionPtr seenFrom(glm::dvec3 eyeM) const override;

private:
    std::shared_ptr<const GridMap> map_;
    MapDirection direction_;
    glm::dmat3 rayFromBase_;  // of homogeneous positions of the base image
    glm::dmat3 baseFromRay_;
};

}  // namespace curvewall
