#include "calibration/readers/projection_fields.h"

#include <glm/trigonometric.hpp>

#include <algorithm>

namespace curvewall {

namespace {
constexpr Range kAngleDeg{-36000, 36000};
constexpr Range kHalfAngleDeg{-89, 89};
}  // namespace

std::optional<glm::dvec3> vector3(JsonFields& fields, const char* key, Range range) {
    const auto numbers = fields.numbers(key, 3, range);
    if (!numbers) return std::nullopt;
    return glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

double requiredNumber(JsonFields& fields, const char* key, Range range) {
    return fields.required(key, fields.number(key, range));
}

Pose readPose(JsonFields& fields) {
    const auto angleRad = [&](const char* key) {
        return glm::radians(fields.number(key, kAngleDeg).value_or(0));
    };
    return {vector3(fields, "center", kAnywhereM).value_or(glm::dvec3(0)),
            {angleRad("yaw_deg"), angleRad("pitch_deg"), angleRad("roll_deg")}};
}

Orientation readOrientationAtInfinity(JsonFields& fields) {
    const Pose pose = readPose(fields);
    if (pose.centerM == glm::dvec3(0)) return pose.orientation;
    throw FieldError(FieldError::Kind::value, fields.nameOf("center"),
                     "[0, 0, 0], since what has no surface is at infinity", describe(pose.centerM));
}

Frustum readFrustumAngles(JsonFields& fields) {
    const auto angleRad = [&](const char* key) {
        return glm::radians(requiredNumber(fields, key, kHalfAngleDeg));
    };
    const Frustum frustum{
        angleRad("left_deg"), angleRad("right_deg"), angleRad("down_deg"), angleRad("up_deg"), {}};
    if (!(frustum.leftRad < frustum.rightRad && frustum.downRad < frustum.upRad))
        throw FieldError(FieldError::Kind::value, fields.nameOf("left_deg"),
                         "left_deg below right_deg and down_deg below up_deg",
                         "an image without area, or mirrored");
    return frustum;
}

std::string readChoice(JsonFields& fields, const char* key, std::initializer_list<const char*> choices) {
    std::string word = fields.text(key).value_or(*choices.begin());
    if (std::ranges::find(choices, word) != choices.end()) return word;
    std::string expected;
    for (const char* choice : choices) expected += (expected.empty() ? "" : ", ") + std::string(choice);
    throw FieldError(FieldError::Kind::value, fields.nameOf(key), "one of " + expected, "\"" + word + "\"");
}

std::string requiredChoice(JsonFields& fields, const char* key, std::initializer_list<const char*> choices) {
    fields.require(key);
    return readChoice(fields, key, choices);
}

std::optional<std::string> readPath(JsonFields& fields, const char* key, const WallFolder& folder) {
    const auto name = fields.text(key);
    if (!name) return std::nullopt;
    std::error_code error;
    if (name->empty() || !std::filesystem::is_regular_file(folder.path / *name, error))
        throw FieldError(FieldError::Kind::value, fields.nameOf(key), "the name of a file that is there",
                         "\"" + *name + "\"");
    return folder.files.emplace_back((folder.path / *name).string());
}

std::string requiredPath(JsonFields& fields, const char* key, const WallFolder& folder) {
    return fields.required(key, readPath(fields, key, folder));
}

std::string describe(glm::dvec3 vector) { return nlohmann::json{vector.x, vector.y, vector.z}.dump(); }

}  // namespace curvewall
