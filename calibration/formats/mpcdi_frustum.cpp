#include "calibration/formats/mpcdi_frustum.h"

#include "calibration/errors.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"

#include <fmt/format.h>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

namespace curvewall {
namespace {

constexpr double kWidestDeg = 178;
constexpr double kSteepestDeg = 90;

Orientation orientationOf(const MpcdiFrustum& f) {
    return {glm::radians(f.yawDeg), glm::radians(f.pitchDeg), glm::radians(f.rollDeg)};
}

bool hasArea(const MpcdiFrustum& f) { return f.leftDeg < f.rightDeg && f.downDeg < f.upDeg; }

MpcdiFrustum fromMagnitudes(MpcdiFrustum f) {
    f.leftDeg = -f.leftDeg;
    f.downDeg = -f.downDeg;
    return f;
}

bool isUsable(const MpcdiFrustum& f) {
    const double steepest =
        std::max({std::abs(f.leftDeg), std::abs(f.rightDeg), std::abs(f.downDeg), std::abs(f.upDeg)});
    return steepest < kSteepestDeg && hasArea(f) && f.rightDeg - f.leftDeg < kWidestDeg &&
           f.upDeg - f.downDeg < kWidestDeg;
}

// How far the shape of the frustum is from the picture's: the logarithm of the quotient.
double shapeError(const MpcdiFrustum& f, glm::dvec2 sizePx) {
    if (!isUsable(f)) return INFINITY;
    const auto tangent = [](double deg) { return std::tan(glm::radians(deg)); };
    const double shape = (tangent(f.rightDeg) - tangent(f.leftDeg)) / (tangent(f.upDeg) - tangent(f.downDeg));
    return std::abs(std::log(shape * sizePx.y / sizePx.x));
}

// Left and down are negative by the standard; only where one is not, something is open.
MpcdiFrustum decideSigns(const MpcdiFrustum& f, glm::dvec2 sizePx, Decisions& decisions) {
    if (!(f.leftDeg > 0 || f.downDeg > 0)) return f;
    const MpcdiFrustum turned = fromMagnitudes(f);
    const bool asMagnitudes = shapeError(turned, sizePx) < shapeError(f, sizePx);
    std::string evidence = fmt::format("leftAngle is {:g} and downAngle {:g}", f.leftDeg, f.downDeg);
    if (!hasArea(f))
        evidence += ", which leaves no picture between them and the other two";
    else
        evidence += fmt::format("; the shape of the picture speaks for {}",
                                asMagnitudes ? "angles without signs" : "a frustum off its axis");
    return decisions.choose<bool>("angle_signs", {{"signed", false}, {"magnitudes", true}}, asMagnitudes,
                                  evidence)
               ? turned
               : f;
}

enum class RadiusUnit { halfWidths, percent, pixels };

// The unit in which half the width of the picture is between 0.5 and 2.4 radians off the axis.
RadiusUnit guessUnit(double f1, double halfWidthPx) {
    const auto isPlausible = [f1](double radius) { return radius / f1 >= 0.5 && radius / f1 <= 2.4; };
    if (isPlausible(1)) return RadiusUnit::halfWidths;
    if (isPlausible(100)) return RadiusUnit::percent;
    if (isPlausible(halfWidthPx)) return RadiusUnit::pixels;
    return f1 > 5 ? RadiusUnit::percent : RadiusUnit::halfWidths;
}

LensPtr fisheyeLens(const MpcdiRegion& region, const MpcdiFisheye& fisheye, glm::dvec2 sizePx,
                    const std::string& path, Decisions& decisions) {
    const RadialFunction function{RadialModel::polynomial, fisheye.coefficients};
    const double limitRad = function.limitRad();
    if (!(limitRad > 0))
        throw InputError(path, region.place + "/fisheye", "coefficients of a radius that grows",
                         fmt::format("f1 = {:g}", fisheye.coefficients[0]));
    const double halfWidthPx = sizePx.x / 2;
    double unitPx = halfWidthPx;
    switch (decisions.choose<RadiusUnit>(
        "fisheye_units",
        {{"half_widths", RadiusUnit::halfWidths},
         {"percent", RadiusUnit::percent},
         {"pixels", RadiusUnit::pixels}},
        guessUnit(fisheye.coefficients[0], halfWidthPx),
        fmt::format("f1 is {:g}, a radius for each radian off the axis", fisheye.coefficients[0]))) {
        case RadiusUnit::halfWidths:
            break;
        case RadiusUnit::percent:
            unitPx = halfWidthPx / 100;
            break;
        case RadiusUnit::pixels:
            unitPx = 1;
            break;
    }
    if (fisheye.anamorphicDeg != 0)
        decisions.warn(
            fmt::format("{}/anamorphic: an angle of {:g} degrees between the lens and the picture "
                        "is left out",
                        region.place, fisheye.anamorphicDeg));
    // An offset shifts the picture off the axis, in half widths to the right and half heights up.
    const glm::dvec2 axisPx = 0.5 * sizePx * (glm::dvec2(1) + fisheye.offset * glm::dvec2(-1, 1));
    return std::make_shared<RadialLens>(function, axisPx, unitPx * glm::dvec2(1, 1 / fisheye.anamorphicRatio),
                                        limitRad);
}

}  // namespace

ProjectionPtr pictureOfRegion(const MpcdiRegion& region, glm::ivec2 sizePx, const std::string& path,
                              Decisions& decisions) {
    if (region.fisheye) {
        if (region.frustum)
            decisions.warn(region.place +
                           "/frustum: its four angles are not used, since the fisheye "
                           "extension describes the lens");
        return std::make_shared<LensProjection>(
            fisheyeLens(region, *region.fisheye, sizePx, path, decisions),
            region.frustum ? orientationOf(*region.frustum) : Orientation{});
    }
    if (!region.frustum) throw InputError(path, region.place, "a frustum", "none");
    const MpcdiFrustum f = decideSigns(*region.frustum, sizePx, decisions);
    if (!isUsable(f))
        throw InputError(path, region.place + "/frustum",
                         "left below right, down below up, within 90 degrees and less than 178 together",
                         fmt::format("leftAngle {:g}, rightAngle {:g}, downAngle {:g}, upAngle {:g}",
                                     f.leftDeg, f.rightDeg, f.downDeg, f.upDeg));
    const Frustum frustum{.leftRad = glm::radians(f.leftDeg),
                          .rightRad = glm::radians(f.rightDeg),
                          .downRad = glm::radians(f.downDeg),
                          .upRad = glm::radians(f.upDeg),
                          .orientation = orientationOf(f)};
    try {
        return std::make_shared<FrustumProjection>(frustum, sizePx);
    } catch (const UsageError& error) {
        throw InputError(path, region.place + "/frustum", "a picture with an area", error.what());
    }
}

glm::dmat3 wallFromFrame(const MpcdiFrame& frame) {
    return glm::transpose(glm::dmat3(frame.pitch, -frame.yaw, -frame.roll));
}

}  // namespace curvewall
