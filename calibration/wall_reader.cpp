#include "calibration/wall_reader.h"

#include "calibration/cylinder.h"
#include "calibration/errors.h"
#include "calibration/json_file.h"
#include "calibration/planar.h"

#include <numbers>
#include <set>

namespace curvewall {
namespace {

constexpr double kRadFromDeg = std::numbers::pi / 180;
constexpr double kMostM = 1e7;  // no wall is larger than the earth
constexpr Range kAnywhereM{-kMostM, kMostM};
constexpr Range kLengthM{0, kMostM, true};
constexpr Range kAngleDeg{-36000, 36000};
constexpr int64_t kMostPx = 16384;

std::optional<glm::dvec3> vector3(JsonFields& fields, const char* key, Range range) {
    const auto numbers = fields.numbers(key, 3, range);
    if (!numbers) return std::nullopt;
    return glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

struct Pose {
    glm::dvec3 centerM;
    Orientation orientation;
};

Pose readPose(JsonFields& fields) {
    const auto angleRad = [&](const char* key) {
        return fields.number(key, kAngleDeg).value_or(0) * kRadFromDeg;
    };
    return {vector3(fields, "center", kAnywhereM).value_or(glm::dvec3(0)),
            {angleRad("yaw_deg"), angleRad("pitch_deg"), angleRad("roll_deg")}};
}

ProjectionPtr readPlanar(JsonFields& fields, glm::dvec3 eyeM, glm::ivec2 sizePx) {
    const Pose pose = readPose(fields);
    const auto corner = [&](const char* key) {
        const glm::dvec3 local = fields.required(key, vector3(fields, key, kAnywhereM));
        return pose.centerM + rotationFromOrientation(pose.orientation) * local;
    };
    const PlanarScreen screen{corner("lower_left"), corner("lower_right"), corner("upper_left")};
    return std::make_shared<PlanarProjection>(screen, eyeM, sizePx);
}

ProjectionPtr readCylinder(JsonFields& fields, glm::dvec3 eyeM, glm::ivec2 sizePx) {
    const Pose pose = readPose(fields);
    const auto number = [&](const char* key, Range range) {
        return fields.required(key, fields.number(key, range));
    };
    const CylinderWall cylinder{number("radius", kLengthM), number("arc_deg", {0, 360, true}) * kRadFromDeg,
                                number("height", kLengthM), pose.centerM, pose.orientation};
    return std::make_shared<CylinderProjection>(cylinder, eyeM, sizePx);
}

ProjectionPtr readProjection(JsonFields& fields, const std::string& type, glm::dvec3 eyeM,
                             glm::ivec2 sizePx) {
    if (type == "planar") return readPlanar(fields, eyeM, sizePx);
    if (type == "cylinder") return readCylinder(fields, eyeM, sizePx);
    throw FieldError(FieldError::Kind::value, fields.nameOf("type"), "planar or cylinder",
                     "\"" + type + "\"");
}

std::string readName(JsonFields& fields, const char* key) {
    std::string name = fields.required(key, fields.text(key));
    if (name.empty())
        throw FieldError(FieldError::Kind::value, fields.nameOf(key), "a name", "an empty string");
    return name;
}

Display readDisplay(JsonFields& fields, glm::dvec3 eyeM) {
    Display display;
    display.name = readName(fields, "name");
    const auto size = fields.required("size", fields.wholeNumbers("size", 2, 1, kMostPx));
    display.sizePx = {static_cast<int>(size[0]), static_cast<int>(size[1])};

    JsonFields projection = fields.required("projection", fields.object("projection"));
    display.projectionType = readName(projection, "type");
    try {
        display.projection = readProjection(projection, display.projectionType, eyeM, display.sizePx);
    } catch (const UsageError& error) {
        throw FieldError(FieldError::Kind::value, fields.nameOf("projection"),
                         "a screen that the eye can see", error.what());
    }
    projection.refuseUnknownKeys();
    fields.refuseUnknownKeys();
    return display;
}

Wall readFields(JsonFields fields) {
    Wall wall;
    wall.name = readName(fields, "wall");
    wall.eyeM = vector3(fields, "eye", kAnywhereM).value_or(glm::dvec3(0));
    wall.background = vector3(fields, "background", {0, 1}).value_or(glm::dvec3(0));
    std::set<std::string> names;
    for (JsonFields& display : fields.objects("displays")) {
        wall.displays.push_back(readDisplay(display, wall.eyeM));
        if (const std::string& name = wall.displays.back().name; !names.insert(name).second)
            throw FieldError(FieldError::Kind::value, display.nameOf("name"), "a name of its own",
                             "\"" + name + "\" again");
    }
    fields.refuseUnknownKeys();
    return wall;
}

}  // namespace

Wall readWall(const std::string& path) { return readJsonFile(path, "a wall file", readFields); }

}  // namespace curvewall
