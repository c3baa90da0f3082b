#include "calibration/readers/lens_reader.h"

#include "calibration/projections/camera_lens.h"
#include "calibration/projections/equirectangular_lens.h"
#include "calibration/projections/radial_lens.h"
#include "calibration/projections/sphere_slices_lens.h"
#include "calibration/readers/projection_fields.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace curvewall {
namespace {

constexpr Range kCoefficient{-1e6, 1e6};
constexpr Range kTiltRad{-1.5, 1.5};  // short of a sensor seen edge on
constexpr Range kFocalPx{0, 1e6, true};
constexpr Range kPrincipalPx{-1e6, 1e6};

struct ModelOfName {
    RadialModel model;
    Range fovDeg;
};

const std::map<std::string, ModelOfName>& radialModels() {
    static const std::map<std::string, ModelOfName> kModels{
        {"equidistant", {RadialModel::equidistant, {0, 360, true}}},
        {"equisolid", {RadialModel::equisolid, {0, 360, true}}},
        {"orthographic", {RadialModel::orthographic, {0, 180, true}}},
        {"polynomial", {RadialModel::polynomial, {0, 360, true}}},
        {"stereographic", {RadialModel::stereographic, {0, 360, true, true}}},
    };
    return kModels;
}

double requiredAngleRad(JsonFields& fields, const char* key, Range rangeDeg) {
    return glm::radians(requiredNumber(fields, key, rangeDeg));
}

void readCoefficients(JsonFields& fields, double edgeRad, RadialFunction& function) {
    const auto coefficients = fields.required(
        "coefficients", fields.numbers("coefficients", {1, 2, 3, 4, 5, 6, 7, 8, 9}, kCoefficient));
    std::ranges::copy(coefficients, function.coefficients.begin());
    const double limitRad = function.limitRad();
    if (limitRad < edgeRad)
        throw FieldError(
            FieldError::Kind::value, fields.nameOf("coefficients"),
            "a polynomial that increases up to half of fov_deg",
            "one that stops increasing at " + std::to_string(glm::degrees(limitRad)) + " degrees");
}

glm::dvec2 requiredPair(JsonFields& fields, const char* key, Range range) {
    const auto pair = fields.required(key, fields.numbers(key, 2, range));
    return {pair[0], pair[1]};
}

// The last two of fourteen are angles.
void checkTilt(const JsonFields& fields, const std::vector<double>& distortion) {
    for (size_t i = 12; i < distortion.size(); ++i)
        if (distortion[i] < kTiltRad.min || distortion[i] > kTiltRad.max)
            throw FieldError(FieldError::Kind::value, fields.nameOf("distortion[" + std::to_string(i) + "]"),
                             "a tilt from -1.5 to 1.5 radians", std::to_string(distortion[i]));
}

}  // namespace

LensPtr readRadialLens(JsonFields& fields, glm::ivec2 sizePx) {
    const std::string name = requiredChoice(
        fields, "model", {"equidistant", "equisolid", "orthographic", "polynomial", "stereographic"});
    const auto& [model, fovDeg] = radialModels().at(name);
    const double fovRad = requiredAngleRad(fields, "fov_deg", fovDeg);
    RadialFunction function{model};
    if (model == RadialModel::polynomial) readCoefficients(fields, 0.5 * fovRad, function);
    return circularLens(function, fovRad, sizePx);
}

LensPtr readEquirectangularLens(JsonFields& fields, glm::ivec2 sizePx) {
    const double horizontalRad = requiredAngleRad(fields, "horizontal_fov_deg", kTurnsDeg);
    const double verticalRad = requiredAngleRad(fields, "vertical_fov_deg", {0, 180, true});
    return std::make_shared<EquirectangularLens>(horizontalRad, verticalRad, sizePx);
}

LensPtr readSphereSlicesLens(JsonFields& fields, glm::ivec2 sizePx) {
    const double horizontalRad = requiredAngleRad(fields, "horizontal_fov_deg", {0, 180, true});
    const double verticalRad = requiredAngleRad(fields, "vertical_fov_deg", {0, 360, true});
    return std::make_shared<SphereSlicesLens>(horizontalRad, verticalRad, sizePx);
}

LensPtr readCurvilinearLens(JsonFields& fields, glm::ivec2 sizePx) {
    return curvilinearLens(requiredAngleRad(fields, "fov_deg", {0, 180, true, true}), sizePx);
}

LensPtr readCameraLens(JsonFields& fields, glm::ivec2) {
    const bool isFisheye = requiredChoice(fields, "model", {"pinhole", "fisheye"}) == "fisheye";
    CameraIntrinsics intrinsics;
    intrinsics.focalPx = requiredPair(fields, "focal_px", kFocalPx);
    intrinsics.principalPx = requiredPair(fields, "principal_px", kPrincipalPx);
    const auto distortion = isFisheye ? fields.numbers("distortion", {0, 4}, kCoefficient)
                                      : fields.numbers("distortion", {0, 4, 5, 8, 12, 14}, kCoefficient);
    intrinsics.distortion = distortion.value_or(std::vector<double>());
    if (isFisheye) return fisheyeCameraLens(intrinsics);
    checkTilt(fields, intrinsics.distortion);
    return std::make_shared<PinholeLens>(intrinsics);
}

}  // namespace curvewall
