#include "calibration/readers/wall_reader.h"

#include "calibration/errors.h"
#include "calibration/files/json_file.h"
#include "calibration/formats/calibration_file.h"
#include "calibration/readers/blend_reader.h"
#include "calibration/readers/grid_reader.h"
#include "calibration/readers/projection_fields.h"
#include "calibration/readers/projection_reader.h"

#include <filesystem>
#include <set>
#include <utility>
#include <vector>

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

glm::ivec2 pixelsOf(const std::vector<int64_t>& size) {
    return {static_cast<int>(size[0]), static_cast<int>(size[1])};
}

BlendMapsPtr blendOf(BlendMaps blend) {
    return blend.empty() ? nullptr : std::make_shared<const BlendMaps>(std::move(blend));
}

Display readDisplay(JsonFields& fields, const WallFolder& folder, glm::dvec3 eyeM) {
    Display display;
    display.name = readName(fields, "name");
    display.sizePx = pixelsOf(fields.required("size", fields.wholeNumbers("size", 2, 1, kMostPx)));
    JsonFields projection = fields.required("projection", fields.object("projection"));
    display.projectionType = readName(projection, "type");
    ReadProjection read = readProjection(projection, display.projectionType, {folder, eyeM, display.sizePx});
    projection.refuseUnknownKeys();
    display.projection = std::move(read.projection);
    BlendMaps blend;
    if (auto blendFields = fields.object("blend")) blend = readBlend(*blendFields, folder, display.sizePx);
    multiplyPicture(blend, read.intensity);
    display.blend = blendOf(std::move(blend));
    return display;
}

Decisions givenDecisions(JsonFields& calibration) {
    const nlohmann::json given = calibration.anyObject("assume").value_or(nlohmann::json::object());
    return Decisions(given, calibration.nameOf("assume"));
}

std::string namesOf(const std::vector<Display>& displays) {
    std::string names;
    for (const Display& display : displays) names += (names.empty() ? "" : ", ") + display.name;
    return names;
}

// The displays of a file that another program wrote; their names are the file's where the wall gives none.
// Its eye becomes `eyeM` where nobody said before where the eye is.
std::vector<Display> readCalibrated(JsonFields& fields, const WallFolder& folder,
                                    std::optional<glm::dvec3>& eyeM) {
    JsonFields calibration = fields.required("calibration", fields.object("calibration"));
    const std::string path = requiredPath(calibration, "file", folder);
    CalibrationRequest request{.eyeM = eyeM};
    request.display = calibration.text("display").value_or("");
    if (const auto size = fields.wholeNumbers("size", 2, 1, kMostPx)) request.sizePx = pixelsOf(*size);
    if (auto source = calibration.object("source"))
        request.source = readSource(*source, {folder, eyeM.value_or(glm::dvec3(0)), glm::ivec2(0)});
    Decisions decisions = givenDecisions(calibration);
    calibration.refuseUnknownKeys();

    Wall wall = readCalibration(readFile(path, "a calibration"), filesBeside(path, &folder.files), request,
                                decisions);
    decisions.refuseUnusedKeys();
    if (!eyeM) eyeM = wall.eyeM;
    if (fields.has("name")) {
        if (wall.displays.size() > 1)
            throw FieldError(FieldError::Kind::value, calibration.nameOf("display"),
                             "one of " + namesOf(wall.displays) + ", since name is for one display",
                             request.display.empty() ? "nothing" : "\"" + request.display + "\"");
        wall.displays.front().name = readName(fields, "name");
    }
    if (auto blendFields = fields.object("blend")) {
        if (wall.displays.size() > 1)
            throw FieldError(FieldError::Kind::value, calibration.nameOf("display"),
                             "one of " + namesOf(wall.displays) + ", since blend is for one display",
                             "nothing");
        Display& display = wall.displays.front();
        display.blend = blendOf(readBlend(*blendFields, folder, display.sizePx));
    }
    return std::move(wall.displays);
}

std::vector<Display> readDisplays(JsonFields& fields, const WallFolder& folder,
                                  std::optional<glm::dvec3>& eyeM) {
    if (fields.has("calibration") && fields.has("projection"))
        throw FieldError(FieldError::Kind::shape, fields.nameOf("projection"),
                         "a projection or a calibration", "both");
    std::vector<Display> displays;
    try {
        if (fields.has("calibration"))
            displays = readCalibrated(fields, folder, eyeM);
        else
            displays.push_back(readDisplay(fields, folder, eyeM.value_or(glm::dvec3(0))));
    } catch (const UsageError& error) {
        throw FieldError(FieldError::Kind::value,
                         fields.nameOf(fields.has("calibration") ? "calibration" : "projection"),
                         "a screen that the eye can see", error.what());
    }
    fields.refuseUnknownKeys();
    return displays;
}

Wall readFields(JsonFields fields, const std::string& path) {
    Wall wall;
    wall.files = {path};
    const WallFolder folder{std::filesystem::path(path).parent_path(), wall.files};
    wall.name = readName(fields, "wall");
    wall.background = vector3(fields, "background", {0, 1}).value_or(glm::dvec3(0));
    std::optional<glm::dvec3> eyeM = vector3(fields, "eye", kAnywhereM);
    std::vector<JsonFields> entries = fields.objects("displays");
    std::vector<std::vector<Display>> displays(entries.size());
    // Calibrations first: the first one may tell where the eye of all displays is.
    for (const bool calibrated : {true, false})
        for (size_t i = 0; i < entries.size(); ++i)
            if (entries[i].has("calibration") == calibrated)
                displays[i] = readDisplays(entries[i], folder, eyeM);
    wall.eyeM = eyeM.value_or(glm::dvec3(0));
    std::set<std::string> names;
    for (size_t i = 0; i < entries.size(); ++i)
        for (Display& display : displays[i]) {
            if (!names.insert(display.name).second)
                throw FieldError(FieldError::Kind::value, entries[i].nameOf("name"), "a name of its own",
                                 "\"" + display.name + "\" again");
            wall.displays.push_back(std::move(display));
        }
    fields.refuseUnknownKeys();
    return wall;
}

bool looksLikeJson(const FileBytes& file) {
    return file.extension() == ".json" || file.bytes.find_first_not_of(" \t\r\n") == file.bytes.find('{');
}

// Nobody wrote a wall file around it, so that there is nothing to complain about but the file itself.
Wall readBareCalibration(const FileBytes& file, std::optional<glm::ivec2> sizePx) {
    Decisions decisions;
    try {
        std::vector<std::string> files{file.path};
        Wall wall = readCalibration(file, filesBeside(file.path, &files), {.sizePx = sizePx}, decisions);
        wall.files = std::move(files);
        return wall;
    } catch (const UsageError& error) {
        throw InputError(file.path, "", "a screen that the eye can see", error.what());
    }
}

}  // namespace

Wall readWall(const std::string& path, std::optional<glm::ivec2> sizePx) {
    const FileBytes file = readFile(path, "a wall file or a calibration");
    if (isCalibration(file) || !looksLikeJson(file)) return readBareCalibration(file, sizePx);
    if (sizePx) throw UsageError(path + " is a wall file, which has the size of each display");
    return readWallFile(file);
}

Wall readWallFile(const FileBytes& file) {
    return readJson(file, [&](JsonFields fields) { return readFields(std::move(fields), file.path); });
}

}  // namespace curvewall
