#include "calibration/projection_reader.h"

#include "calibration/cylinder.h"
#include "calibration/grid_reader.h"
#include "calibration/planar.h"
#include "calibration/projection_fields.h"

#include <glm/trigonometric.hpp>

#include <functional>
#include <map>

namespace curvewall {
namespace {

ProjectionPtr readPlanar(JsonFields& fields, const ProjectionContext& context) {
    const Pose pose = readPose(fields);
    const auto corner = [&](const char* key) {
        const glm::dvec3 local = fields.required(key, vector3(fields, key, kAnywhereM));
        return pose.centerM + rotationFromOrientation(pose.orientation) * local;
    };
    const PlanarScreen screen{corner("lower_left"), corner("lower_right"), corner("upper_left")};
    return std::make_shared<PlanarProjection>(screen, context.eyeM, context.sizePx);
}

ProjectionPtr readCylinder(JsonFields& fields, const ProjectionContext& context) {
    const Pose pose = readPose(fields);
    const CylinderWall cylinder{requiredNumber(fields, "radius", kLengthM),
                                glm::radians(requiredNumber(fields, "arc_deg", {0, 360, true})),
                                requiredNumber(fields, "height", kLengthM), pose.centerM, pose.orientation};
    return std::make_shared<CylinderProjection>(cylinder, context.eyeM, context.sizePx);
}

using ReadType = std::function<ReadProjection(JsonFields& fields, const ProjectionContext& context)>;

const std::map<std::string, ReadType>& readers() {
    static const std::map<std::string, ReadType> kReaders{
        {"camera_texture", readCameraTexture}, {"cylinder", readCylinder},  {"planar", readPlanar},
        {"surface_map", readSurfaceMap},       {"warp_mesh", readWarpMesh},
    };
    return kReaders;
}

}  // namespace

ReadProjection readProjection(JsonFields& fields, const std::string& type, const ProjectionContext& context) {
    const auto reader = readers().find(type);
    if (reader != readers().end()) return reader->second(fields, context);
    std::string names;
    for (const auto& [name, read] : readers()) names += (names.empty() ? "" : ", ") + name;
    throw FieldError(FieldError::Kind::value, fields.nameOf("type"), "one of " + names, "\"" + type + "\"");
}

}  // namespace curvewall
