#include "calibration/readers/wall_reader.h"

#include "calibration/errors.h"
#include "calibration/files/json_file.h"
#include "calibration/readers/blend_reader.h"
#include "calibration/readers/projection_fields.h"
#include "calibration/readers/projection_reader.h"

#include <filesystem>
#include <set>
#include <utility>

namespace curvewall {
namespace {

std::string readName(JsonFields& fields, const char* key) {
    std::string name = fields.required(key, fields.text(key));
    // Names become parts of file names.
    if (name.empty() || name.find('/') != std::string::npos)
        throw FieldError(FieldError::Kind::value, fields.nameOf(key), "a name without slashes",
                         "\"" + name + "\"");
    return name;
}

Display readDisplay(JsonFields& fields, const std::filesystem::path& folder, glm::dvec3 eyeM) {
    Display display;
    display.name = readName(fields, "name");
    const auto size = fields.required("size", fields.wholeNumbers("size", 2, 1, kMostPx));
    display.sizePx = {static_cast<int>(size[0]), static_cast<int>(size[1])};

    JsonFields projection = fields.required("projection", fields.object("projection"));
    display.projectionType = readName(projection, "type");
    ReadProjection read;
    try {
        read = readProjection(projection, display.projectionType, {folder, eyeM, display.sizePx});
    } catch (const UsageError& error) {
        throw FieldError(FieldError::Kind::value, fields.nameOf("projection"),
                         "a screen that the eye can see", error.what());
    }
    projection.refuseUnknownKeys();
    display.projection = std::move(read.projection);
    BlendMaps blend;
    if (auto blendFields = fields.object("blend")) blend = readBlend(*blendFields, folder, display.sizePx);
    multiplyPicture(blend, read.intensity);
    if (!blend.empty()) display.blend = std::make_shared<const BlendMaps>(std::move(blend));
    fields.refuseUnknownKeys();
    return display;
}

Wall readFields(JsonFields fields, const std::filesystem::path& folder) {
    Wall wall;
    wall.name = readName(fields, "wall");
    wall.eyeM = vector3(fields, "eye", kAnywhereM).value_or(glm::dvec3(0));
    wall.background = vector3(fields, "background", {0, 1}).value_or(glm::dvec3(0));
    std::set<std::string> names;
    for (JsonFields& display : fields.objects("displays")) {
        wall.displays.push_back(readDisplay(display, folder, wall.eyeM));
        if (const std::string& name = wall.displays.back().name; !names.insert(name).second)
            throw FieldError(FieldError::Kind::value, display.nameOf("name"), "a name of its own",
                             "\"" + name + "\" again");
    }
    fields.refuseUnknownKeys();
    return wall;
}

}  // namespace

Wall readWall(const std::string& path) {
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    return readJsonFile(path, "a wall file",
                        [&](JsonFields fields) { return readFields(std::move(fields), folder); });
}

}  // namespace curvewall
