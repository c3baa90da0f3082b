#include "calibration/readers/projection_reader.h"

#include "calibration/projections/cylinder.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/planar.h"
#include "calibration/readers/grid_reader.h"
#include "calibration/readers/lens_reader.h"
#include "calibration/readers/projection_fields.h"

#include <glm/trigonometric.hpp>

#include <functional>
#include <map>
#include <optional>
#include <utility>

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

ProjectionPtr readFrustum(JsonFields& fields, const ProjectionContext& context) {
    Frustum frustum = readFrustumAngles(fields);
    frustum.orientation = readOrientationAtInfinity(fields);
    return std::make_shared<FrustumProjection>(frustum, context.sizePx);
}

ProjectionPtr readCylinder(JsonFields& fields, const ProjectionContext& context) {
    const Pose pose = readPose(fields);
    const CylinderWall cylinder{requiredNumber(fields, "radius", kLengthM),
                                glm::radians(requiredNumber(fields, "arc_deg", kTurnsDeg)),
                                requiredNumber(fields, "height", kLengthM), pose.centerM, pose.orientation};
    return std::make_shared<CylinderProjection>(cylinder, context.eyeM, context.sizePx);
}

// Nothing, a lens at infinity, or the inside of a sphere.
std::optional<DomeSurface> readSurface(JsonFields& fields) {
    auto surface = fields.object("surface");
    if (!surface) return std::nullopt;
    requiredChoice(*surface, "type", {"sphere"});
    const DomeSurface dome{surface->required("center", vector3(*surface, "center", kAnywhereM)),
                           requiredNumber(*surface, "radius", kLengthM)};
    surface->refuseUnknownKeys();
    return dome;
}

template <LensPtr (*ReadLens)(JsonFields&, glm::ivec2)>
ProjectionPtr readThroughLens(JsonFields& fields, const ProjectionContext& context) {
    const Pose pose = readPose(fields);
    LensPtr lens = ReadLens(fields, context.sizePx);
    if (const auto dome = readSurface(fields))
        return std::make_shared<DomeProjection>(std::move(lens), pose, *dome, context.eyeM);
    return std::make_shared<LensProjection>(std::move(lens), readOrientationAtInfinity(fields));
}

using ReadType = std::function<ReadProjection(JsonFields& fields, const ProjectionContext& context)>;

const std::map<std::string, ReadType>& readers() {
    static const std::map<std::string, ReadType> kReaders{
        {"camera", readThroughLens<readCameraLens>},
        {"camera_texture", readCameraTexture},
        {"curvilinear", readThroughLens<readCurvilinearLens>},
        {"cylinder", readCylinder},
        {"equirectangular", readThroughLens<readEquirectangularLens>},
        {"frustum", readFrustum},
        {"planar", readPlanar},
        {"radial", readThroughLens<readRadialLens>},
        {"sphere_slices", readThroughLens<readSphereSlicesLens>},
        {"surface_map", readSurfaceMap},
        {"warp_mesh", readWarpMesh},
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
