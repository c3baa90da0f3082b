#pragma once
// Lenses that are round about their axis: fisheyes, dome masters, and the curvilinear view.

#include "calibration/projections/lens.h"
#include "calibration/projections/projection_maths.h"

#include <array>

namespace curvewall {

enum class RadialModel {
    orthographic = maths::kOrthographic,    // r = sin t
    stereographic = maths::kStereographic,  // r = 2 tan(t / 2)
    equisolid = maths::kEquisolid,          // r = 2 sin(t / 2), Lambert's equal-area map
    equidistant = maths::kEquidistant,      // r = t
    polynomial = maths::kPolynomial,        // r = c1 t + c2 t^2 + ...
};

// How far from the centre of the picture, in focal lengths, a ray lands that is t radians off the axis.
struct RadialFunction {
    RadialModel model = RadialModel::equidistant;
    std::array<double, maths::kRadialTerms> coefficients{};  // of the polynomial, c1 first

    double radius(double angleRad) const;

    // The angle up to which the radius grows and is finite, half a turn at most; 0 where it never does.
    double limitRad() const;

    bool operator==(const RadialFunction&) const = default;
};

class RadialLens : public Lens {
public:
    // `focalPx` may differ along x and y. Pixels that would look further off the axis than `edgeRad`, which
    // is at most the function's limit, show nothing; rays beyond it have positions as far as the function
    // grows.
    RadialLens(const RadialFunction& function, glm::dvec2 centrePx, glm::dvec2 focalPx, double edgeRad);

    std::optional<glm::dvec3> direction(glm::dvec2 px) const override;
    std::vector<glm::dvec2> positions(glm::dvec3 direction) const override;

    const RadialFunction& function() const { return function_; }
    glm::dvec2 centrePx() const { return centrePx_; }
    glm::dvec2 focalPx() const { return focalPx_; }
    double edgeRad() const { return edgeRad_; }
    double limitRad() const { return limitRad_; }  // up to which the function grows

private:
    RadialFunction function_;
    glm::dvec2 centrePx_;
    glm::dvec2 focalPx_;
    double edgeRad_;
    double edgeRadius_;
    double limitRad_;
};

// The largest circle that fits the picture shows `fovRad` from side to side; outside it there is nothing.
LensPtr circularLens(const RadialFunction& function, double fovRad, glm::ivec2 sizePx);

// Spherical curvilinear projection (Oros): the perspective view `fovRad` wide with each point's depth
// replaced by the mean of depth and distance. A point t off the axis then lands at sin t / ((1 + cos t) / 2)
// = 2 tan(t/2), which is the stereographic map on a rectangle.
LensPtr curvilinearLens(double fovRad, glm::ivec2 sizePx);

}  // namespace curvewall
