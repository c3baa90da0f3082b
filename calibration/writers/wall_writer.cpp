#include "calibration/writers/wall_writer.h"

#include <glm/trigonometric.hpp>

#include <charconv>
#include <iterator>

namespace curvewall {
namespace {

using Json = nlohmann::ordered_json;

Json entryOf(const Display& display) {
    return {{"name", display.name}, {"size", {display.sizePx.x, display.sizePx.y}}};
}

const char* wordOf(Alignment alignment) { return alignment == Alignment::centers ? "centers" : "corners"; }

void addOrientation(Json& projection, const Orientation& orientation) {
    projection["yaw_deg"] = glm::degrees(orientation.yawRad);
    projection["pitch_deg"] = glm::degrees(orientation.pitchRad);
    projection["roll_deg"] = glm::degrees(orientation.rollRad);
}

// The double nearest to the shortest decimal that gives the float back: its digits are what JSON then shows.
double shortest(float number) {
    char digits[32];
    const std::to_chars_result written = std::to_chars(std::begin(digits), std::end(digits), number);
    double value = number;
    std::from_chars(digits, written.ptr, value);
    return value;
}

}  // namespace

Json cameraTextureEntry(const Display& display, const std::string& file, Alignment alignment,
                        const Frustum& base) {
    Json projection = {{"type", "camera_texture"}};
    projection["base"] = {{"left_deg", glm::degrees(base.leftRad)},
                          {"right_deg", glm::degrees(base.rightRad)},
                          {"down_deg", glm::degrees(base.downRad)},
                          {"up_deg", glm::degrees(base.upRad)}};
    addOrientation(projection, base.orientation);
    projection.update({{"offsets", file},
                       {"direction", "inverse"},
                       {"semantics", "offset"},
                       {"alignment", wordOf(alignment)},
                       {"origin", "top_left"},
                       {"units", "px"}});
    Json entry = entryOf(display);
    entry["projection"] = std::move(projection);
    return entry;
}

Json surfaceMapEntry(const Display& display, const std::string& file, Alignment alignment) {
    Json entry = entryOf(display);
    entry["projection"] = {{"type", "surface_map"},
                           {"points", file},
                           {"units", "m"},
                           {"alignment", wordOf(alignment)},
                           {"origin", "top_left"}};
    return entry;
}

Json bourkeEntry(const Display& display, const std::string& file, const FisheyeSource& source,
                 bool hasIntensity) {
    Json fisheye = {{"type", "radial"}, {"model", "equidistant"}, {"fov_deg", glm::degrees(source.fovRad)}};
    addOrientation(fisheye, source.orientation);
    Json assume = {{"interpolation", "triangles"}};
    if (hasIntensity) assume["intensity_gamma"] = kIntensityGamma;
    Json entry = entryOf(display);
    entry["calibration"] = {
        {"file", file},
        {"assume", std::move(assume)},
        {"source", {{"size", {source.sidePx, source.sidePx}}, {"projection", std::move(fisheye)}}}};
    return entry;
}

std::string wallFile(const Wall& wall, const std::vector<Json>& displays) {
    const Json file = {
        {"wall", wall.name},
        {"eye", {wall.eyeM.x, wall.eyeM.y, wall.eyeM.z}},
        {"background",
         {shortest(wall.background.r), shortest(wall.background.g), shortest(wall.background.b)}},
        {"displays", displays}};
    return file.dump(2) + "\n";
}

}  // namespace curvewall
