#include "calibration/formats/sgct_projection.h"

#include "calibration/errors.h"
#include "calibration/projections/cylinder.h"
#include "calibration/projections/equirectangular_lens.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/picture_views.h"
#include "calibration/projections/planar.h"
#include "calibration/projections/radial_lens.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

namespace curvewall {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kUsualDistanceM = 10;  // SGCT's

// Where SGCT's code and its documentation disagree.
enum class SgctConvention { program, documentation };

SgctConvention decideConvention(const std::string& evidence, Decisions& decisions) {
    return decisions.choose(
        "sgct_convention",
        {{"program", SgctConvention::program}, {"documentation", SgctConvention::documentation}},
        SgctConvention::program, evidence);
}

PlanarScreen screenOf(const SgctPlane& plane) {
    return {plane.lowerLeftM, plane.lowerLeftM + plane.upperRightM - plane.upperLeftM, plane.upperLeftM};
}

PlanarScreen screenOf(const SgctPlanar& planar, double distanceM) {
    const auto corner = [&](double horizontalDeg, double verticalDeg) {
        return planar.rotation * (distanceM * glm::dvec3(std::tan(glm::radians(horizontalDeg)),
                                                         std::tan(glm::radians(verticalDeg)), -1)) +
               planar.offsetM;
    };
    return {corner(planar.leftDeg, planar.downDeg), corner(planar.rightDeg, planar.downDeg),
            corner(planar.leftDeg, planar.upDeg)};
}

// The screen's distance is nothing to an eye in its origin, which is where most users are.
double decideDistanceM(const SgctPlanar& planar, glm::dvec3 eyeM, Decisions& decisions) {
    if (planar.distanceM) return *planar.distanceM;
    if (eyeM == planar.offsetM) return kUsualDistanceM;
    return decisions.number(
        "distance_m", {1e-6, 1e7}, kUsualDistanceM,
        "the eye is not where the angles are measured from, and the file does not say how far "
        "the screen is; SGCT takes 10 m");
}

void requirePositiveArea(const SgctPlanar& planar) {
    if (planar.leftDeg < planar.rightDeg && planar.downDeg < planar.upDeg) return;
    throw UsageError(fmt::format("its angles are left {}, right {}, down {} and up {} degrees",
                                 planar.leftDeg, planar.rightDeg, planar.downDeg, planar.upDeg));
}

SgctPicture pictureOf(const SgctPlane& plane, const SgctScreen& screen, const SgctEye& eye, Decisions&) {
    return {std::make_shared<PlanarProjection>(screenOf(plane), eye.eyeM, screen.sizePx), "planar"};
}

SgctPicture pictureOf(const SgctPlanar& planar, const SgctScreen& screen, const SgctEye& eye,
                      Decisions& decisions) {
    requirePositiveArea(planar);
    const double distanceM = decideDistanceM(planar, eye.eyeM, decisions);
    return {std::make_shared<PlanarProjection>(screenOf(planar, distanceM), eye.eyeM, screen.sizePx),
            "planar"};
}

// The rectangle of the screen that the fisheye's square picture, cut by its crop, is laid on.
struct FisheyePlace {
    glm::dvec2 centrePx{0};  // of the whole square
    glm::dvec2 radiusPx{0};
    glm::dvec2 lowPx{0}, highPx{0};
};

FisheyePlace placeOf(const SgctFisheye& fisheye, const SgctScreen& screen) {
    const glm::dvec2 size(screen.sizePx);
    const glm::dvec2 kept(1 - fisheye.cropLeft - fisheye.cropRight, 1 - fisheye.cropBottom - fisheye.cropTop);
    glm::dvec2 share(1);
    if (fisheye.keepsAspect) {
        const double aspect = screen.pictureAspect.value_or(size.x / size.y) * kept.y / kept.x;
        if (aspect >= 1)
            share.x = 1 / aspect;
        else
            share.y = aspect;
    }
    FisheyePlace place;
    place.lowPx = 0.5 * size * (1.0 - share);
    place.highPx = size - place.lowPx;
    const glm::dvec2 squarePx = size * share / kept;
    place.radiusPx = 0.5 * squarePx;
    place.centrePx = place.lowPx + squarePx * (0.5 - glm::dvec2(fisheye.cropLeft, fisheye.cropTop));
    return place;
}

bool cutsTheCircle(const FisheyePlace& place) {
    constexpr double kSlackPx = 1e-6;
    const glm::dvec2 low = place.centrePx - place.radiusPx, high = place.centrePx + place.radiusPx;
    return low.x < place.lowPx.x - kSlackPx || low.y < place.lowPx.y - kSlackPx ||
           high.x > place.highPx.x + kSlackPx || high.y > place.highPx.y + kSlackPx;
}

// SGCT's sphere has the radius one about the middle of the lens, and its offset moves the eye. Its shader has
// y down and z ahead.
ProjectionPtr domeOf(const SgctFisheye& fisheye, LensPtr lens, const Orientation& orientation,
                     const SgctEye& eye) {
    const glm::dvec3 offset(fisheye.offsetRadii.x, -fisheye.offsetRadii.y, -fisheye.offsetRadii.z);
    const double radiusM = 0.5 * fisheye.diameterM;
    const glm::dvec3 centreM = eye.userM - radiusM * (rotationFromOrientation(orientation) * offset);
    return std::make_shared<DomeProjection>(std::move(lens), Pose{centreM, orientation},
                                            DomeSurface{centreM, radiusM}, eye.eyeM);
}

SgctPicture pictureOf(const SgctFisheye& fisheye, const SgctScreen& screen, const SgctEye& eye, Decisions&) {
    const FisheyePlace place = placeOf(fisheye, screen);
    const double edgeRad = glm::radians(fisheye.fovDeg) / 2;
    LensPtr lens = std::make_shared<RadialLens>(RadialFunction{RadialModel::equidistant}, place.centrePx,
                                                place.radiusPx / edgeRad, edgeRad);
    const Orientation orientation{.pitchRad = glm::radians(90 - fisheye.tiltDeg)};
    const bool isOffAxis = fisheye.offsetRadii != glm::dvec3(0) || eye.eyeM != eye.userM;
    ProjectionPtr projection = isOffAxis ? domeOf(fisheye, std::move(lens), orientation, eye)
                                         : std::make_shared<LensProjection>(std::move(lens), orientation);
    if (cutsTheCircle(place))
        projection = std::make_shared<CroppedProjection>(std::move(projection), place.lowPx, place.highPx);
    return {std::move(projection), "radial"};
}

// The left border looks 135 degrees to the right of ahead, because SGCT turns its cube of pictures by an
// eighth and looks the turned cube up unturned; the heights are those above a circle of radius one.
SgctPicture pictureOf(const SgctCylinder& cylinder, const SgctScreen& screen, const SgctEye& eye,
                      Decisions& decisions) {
    const auto convention = decideConvention(
        "SGCT's shader begins 135 degrees to the right of ahead and takes the rotation in degrees; its "
        "documentation says ahead and radians",
        decisions);
    const bool isProgram = convention == SgctConvention::program;
    const CylinderWall wall{
        .radiusM = cylinder.radiusM,
        .arcRad = 2 * kPi,
        .heightM = cylinder.radiusM,
        .centerM = eye.userM + glm::dvec3(0, cylinder.radiusM * (cylinder.heightOffset + 0.5), 0),
        .orientation = {.yawRad = isProgram ? glm::radians(135.0) + kPi - glm::radians(cylinder.rotation)
                                            : kPi - cylinder.rotation}};
    return {std::make_shared<CylinderProjection>(wall, eye.eyeM, screen.sizePx), "cylinder"};
}

SgctPicture pictureOf(const SgctEquirectangular&, const SgctScreen& screen, const SgctEye&,
                      Decisions& decisions) {
    const auto convention = decideConvention(
        "the middle of the picture that SGCT draws looks 45 degrees to the right of ahead", decisions);
    return {std::make_shared<LensProjection>(
                std::make_shared<EquirectangularLens>(2 * kPi, kPi, screen.sizePx),
                Orientation{.yawRad = convention == SgctConvention::program ? kPi / 4 : 0}),
            "equirectangular"};
}

template <class Other>
SgctPicture pictureOf(const Other&, const SgctScreen&, const SgctEye&, Decisions&) {
    throw UsageError("this projection has no picture of its own");
}

// A face of a cube seen from its middle: a quarter turn in both directions.
constexpr double kFaceRad = kPi / 4;
Frustum faceTowards(const Orientation& orientation) {
    return {-kFaceRad, kFaceRad, -kFaceRad, kFaceRad, orientation};
}

constexpr double kQuarterRad = kPi / 2;

// Of the rotation that looks at a face and is then turned by `rotation`.
Orientation turned(const glm::dmat3& rotation, const Orientation& face) {
    return orientationFromRotation(rotation * rotationFromOrientation(face));
}

}  // namespace

SgctPicture sgctPicture(const SgctProjection& projection, const SgctScreen& screen, const SgctEye& eye,
                        Decisions& decisions) {
    return std::visit([&](const auto& p) { return pictureOf(p, screen, eye, decisions); }, projection);
}

std::vector<SgctFace> sgctMirrorFaces(const SgctMirror& mirror, glm::dvec2 facePx) {
    const glm::dmat3 tilt = rotationFromOrientation({.pitchRad = glm::radians(45 - mirror.tiltDeg)});
    const auto face = [&](const char* name, const Orientation& orientation) {
        return SgctFace{name,
                        std::make_shared<FrustumProjection>(faceTowards(turned(tilt, orientation)), facePx)};
    };
    // What SGCT calls the bottom is the face ahead.
    return {face("bottom", {}), face("left", {.yawRad = -kQuarterRad}),
            face("right", {.yawRad = kQuarterRad}), face("top", {.pitchRad = kQuarterRad})};
}

std::vector<SgctFace> sgctCubeFaces(const SgctCube& cube, Decisions& decisions) {
    Orientation cubeOrientation{glm::radians(cube.yawDeg), glm::radians(cube.pitchDeg),
                                glm::radians(cube.rollDeg)};
    if (cube.yawDeg != cube.pitchDeg &&
        decideConvention("SGCT turns the cube's yaw by what the file calls pitch, and the other way round",
                         decisions) == SgctConvention::program)
        std::swap(cubeOrientation.yawRad, cubeOrientation.pitchRad);
    const glm::dmat3 rotation = rotationFromOrientation(cubeOrientation);
    std::vector<SgctFace> faces;
    const auto add = [&](bool isShown, const char* name, const Orientation& orientation) {
        if (isShown)
            faces.push_back({name, std::make_shared<FrustumProjection>(
                                       faceTowards(turned(rotation, orientation)), glm::dvec2(cube.facePx))});
    };
    add(cube.right, "right", {.yawRad = kQuarterRad});
    add(cube.left, "left", {.yawRad = -kQuarterRad});
    add(cube.bottom, "bottom", {.pitchRad = -kQuarterRad});
    add(cube.top, "top", {.pitchRad = kQuarterRad});
    add(cube.front, "front", {});
    add(cube.back, "back", {.yawRad = kPi});
    return faces;
}

std::optional<SgctView> sgctView(const SgctProjection& projection, glm::dvec3 eyeM) {
    PlanarScreen screen;
    if (const auto* planar = std::get_if<SgctPlanar>(&projection))
        screen = screenOf(*planar, planar->distanceM.value_or(kUsualDistanceM));
    else if (const auto* plane = std::get_if<SgctPlane>(&projection))
        screen = screenOf(*plane);
    else
        return std::nullopt;
    const glm::dvec3 right = glm::normalize(screen.lowerRightM - screen.lowerLeftM);
    const glm::dvec3 upwards = screen.upperLeftM - screen.lowerLeftM;
    const glm::dvec3 back = glm::normalize(glm::cross(right, upwards));
    const glm::dmat3 rotation(right, glm::cross(back, right), back);
    const auto angleDeg = [&](glm::dvec3 corner, int axis) {
        const glm::dvec3 inView = glm::transpose(rotation) * (corner - eyeM);
        return glm::degrees(std::atan2(inView[axis], -inView.z));
    };
    return SgctView{angleDeg(screen.lowerLeftM, 0), angleDeg(screen.lowerRightM, 0),
                    angleDeg(screen.lowerLeftM, 1), angleDeg(screen.upperLeftM, 1), rotation};
}

}  // namespace curvewall
