#pragma once
// Displays whose distortion is radial: every ray lies in the plane that one projection through a flat screen
// and one axis span, r ~ P (x, y, 1) + h(x, y) c. Lenses of any radial model are of this kind, and cameras
// without tangential distortion.

#include "calibration/pieces/plane_envelope.h"
#include "calibration/projections/projection.h"

#include <glm/mat2x2.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <optional>

namespace curvewall {

class RadialMap {
public:
    // Nothing where the display is not of this kind to `mostAsidePx`, which is how far a pixel may lie beside
    // the line on the screen that its ray allows. Keeps a reference to the projection.
    static std::optional<RadialMap> of(const Projection& projection, glm::ivec2 sizePx, double mostAsidePx);

    // h: how far the surface lies along the axis over a place of the flat screen; nothing in holes.
    std::optional<double> height(glm::dvec2 px) const;

    // The point of a surface of this height over a place.
    glm::dvec3 pointAt(glm::dvec2 px, double height) const {
        return base_ * glm::dvec3(px, 1) + height * axis_;
    }

    // Maps (px, 1) to the points of a facet whose height over the screen is a plane: the inverse of its H.
    glm::dmat3 pointsOf(const HeightPlane& plane) const;

    // The same display with heights of the other sign.
    RadialMap turnedOver() const;

    // A place of the screen from one on the flat screen, which has the centre at its origin.
    glm::dvec2 pxAt(glm::dvec2 flat) const { return centrePx_ + glm::inverse(flatFromPx_) * flat; }
    const glm::dmat2& flatFromPx() const { return flatFromPx_; }

    const glm::dvec3& axis() const { return axis_; }
    glm::dvec2 centrePx() const { return centrePx_; }
    glm::ivec2 sizePx() const { return sizePx_; }

private:
    RadialMap(const Projection& projection, glm::ivec2 sizePx) : projection_(&projection), sizePx_(sizePx) {}

    const Projection* projection_;
    glm::ivec2 sizePx_;
    glm::dmat2 flatFromPx_{1};
    glm::dmat3 base_{1};
    glm::dvec3 axis_{0, 0, 1};
    glm::dvec2 centrePx_{0};
};

}  // namespace curvewall
