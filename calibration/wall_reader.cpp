#include "calibration/wall_reader.h"

#include "calibration/cylinder.h"
#include "calibration/errors.h"
#include "calibration/json_fields.h"
#include "calibration/planar.h"

#include <limits>
#include <numbers>
#include <set>

namespace curvewall {
namespace {

constexpr double kRadFromDeg = std::numbers::pi / 180;
constexpr double kMostM = 1e7;  // no wall is larger than the earth
constexpr Range kAnywhereM{-kMostM, kMostM};
constexpr Range kLengthM{0, kMostM, true};
constexpr Range kAngleDeg{-36000, 36000};
constexpr Range kSizePx{1, 16384};

struct Pose {
    glm::dvec3 centerM;
    Orientation orientation;
};

Pose readPose(JsonFields& fields) {
    return {fields.vector3("center", kAnywhereM, glm::dvec3(0)),
            {fields.number("yaw_deg", kAngleDeg, 0) * kRadFromDeg,
             fields.number("pitch_deg", kAngleDeg, 0) * kRadFromDeg,
             fields.number("roll_deg", kAngleDeg, 0) * kRadFromDeg}};
}

ProjectionPtr readPlanar(JsonFields& fields, glm::dvec3 eyeM, glm::ivec2 sizePx) {
    const Pose pose = readPose(fields);
    const auto corner = [&](std::string_view key) {
        return pose.centerM + rotationFromOrientation(pose.orientation) * fields.vector3(key, kAnywhereM);
    };
    const PlanarScreen screen{corner("lower_left"), corner("lower_right"), corner("upper_left")};
    return std::make_shared<PlanarProjection>(screen, eyeM, sizePx);
}

ProjectionPtr readCylinder(JsonFields& fields, glm::dvec3 eyeM, glm::ivec2 sizePx) {
    const Pose pose = readPose(fields);
    const CylinderWall cylinder{fields.number("radius", kLengthM),
                                fields.number("arc_deg", {0, 360, true}) * kRadFromDeg,
                                fields.number("height", kLengthM), pose.centerM, pose.orientation};
    return std::make_shared<CylinderProjection>(cylinder, eyeM, sizePx);
}

ProjectionPtr readProjection(JsonFields& fields, const std::string& type, glm::dvec3 eyeM,
                             glm::ivec2 sizePx) {
    if (type == "planar") return readPlanar(fields, eyeM, sizePx);
    if (type == "cylinder") return readCylinder(fields, eyeM, sizePx);
    fields.fail("type", "one of \"planar\", \"cylinder\"", "\"" + type + "\"");
}

Display readDisplay(JsonFields fields, glm::dvec3 eyeM) {
    Display display;
    display.name = fields.text("name");
    const nlohmann::json& size = fields.array("size", 2);
    const nlohmann::json named = {{"width", size[0]}, {"height", size[1]}};
    JsonFields axes(fields.file(), fields.pathOf("size"), named);
    display.sizePx = {axes.integer("width", kSizePx), axes.integer("height", kSizePx)};

    JsonFields projection = fields.object("projection");
    display.projectionType = projection.text("type");
    try {
        display.projection = readProjection(projection, display.projectionType, eyeM, display.sizePx);
    } catch (const UsageError& error) {
        fields.fail("projection", "a screen that the eye can see", error.what());
    }
    projection.rejectOthers();
    fields.rejectOthers();
    return display;
}

}  // namespace

Wall readWall(const std::string& path) {
    const nlohmann::json root = readJsonFile(path);
    JsonFields fields(path, "", root);
    Wall wall;
    wall.name = fields.text("wall");
    wall.eyeM = fields.vector3("eye", kAnywhereM, glm::dvec3(0));
    wall.background = glm::vec3(fields.vector3("background", {0, 1}, glm::dvec3(0)));

    std::set<std::string> names;
    const nlohmann::json& displays = fields.array("displays", 0);
    for (size_t i = 0; i < displays.size(); ++i) {
        const std::string place = "displays[" + std::to_string(i) + "]";
        wall.displays.push_back(readDisplay(JsonFields(path, place, displays[i]), wall.eyeM));
        if (!names.insert(wall.displays.back().name).second)
            throw InputError(path, place + ".name", "a name of its own",
                             "\"" + wall.displays.back().name + "\" again");
    }
    fields.rejectOthers();
    return wall;
}

}  // namespace curvewall
