#pragma once
// Cameras and projectors as OpenCV calibrates them.

#include "calibration/projections/lens.h"
#include "calibration/projections/projection_maths.h"

#include <array>
#include <vector>

namespace curvewall {

// Numbers as OpenCV writes them: in pixels whose centres are whole numbers, in a frame with y down and z
// ahead.
struct CameraIntrinsics {
    glm::dvec2 focalPx{1};
    glm::dvec2 principalPx{0};
    std::vector<double> distortion;  // what is left out is 0
};

// The pinhole model with distortion k1 k2 p1 p2 [k3 [k4 k5 k6 [s1 s2 s3 s4 [tau_x tau_y]]]]. Only the disc
// around the axis in which the distortion is one-to-one is used: pixels that no ray of it reaches show
// nothing.
class PinholeLens : public Lens {
public:
    explicit PinholeLens(const CameraIntrinsics& intrinsics);

    std::optional<glm::dvec3> direction(glm::dvec2 px) const override;
    std::vector<glm::dvec2> positions(glm::dvec3 direction) const override;

    // The radius of the disc: the tangent of the angle off the axis.
    double mostRadius() const { return mostRadius_; }

    const std::array<double, maths::kPinholeTerms>& terms() const { return terms_; }
    const glm::dmat3& tilt() const { return tilt_; }
    const CameraIntrinsics& intrinsics() const { return intrinsics_; }

private:
    void fillTable();
    bool isWithinReach(glm::dvec2 distorted) const;
    glm::dvec2 startFor(glm::dvec2 distorted) const;
    double tolerance() const;

    std::array<double, maths::kPinholeTerms> terms_{};
    CameraIntrinsics intrinsics_;
    glm::dmat3 tilt_;
    glm::dmat3 untilt_;
    double mostRadius_;
    double mostDistortedRadius_;  // no point of the disc is distorted to beyond it

    // The undistorted points of a grid over the picture, row by row, from which its inverse begins: one step
    // of Newton's then is enough. NaN where there is none.
    glm::dvec2 tableExtent_;
    std::vector<glm::dvec2> table_;
};

// OpenCV's fisheye model with distortion k1 k2 k3 k4: an odd polynomial in the angle, used up to its turning
// point.
LensPtr fisheyeCameraLens(const CameraIntrinsics& intrinsics);

}  // namespace curvewall
