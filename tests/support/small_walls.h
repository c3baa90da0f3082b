#pragma once
// The walls of configs/ with a fraction of their pixels, so that every method can be tried on each of them.

#include "calibration/files/map_file.h"
#include "calibration/readers/wall_reader.h"
#include "tests/support/map_writer.h"
#include "tests/support/temporary_folder.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <string>

namespace curvewall::test {

namespace small_walls {

using nlohmann::json;

inline const std::string kConfigs = CURVEWALL_SOURCE_DIR "/configs/";

inline void divide(json& number, double divisor) { number = number.get<double>() / divisor; }

// Maps are named relative to the wall file, which moves.
inline void nameMapsInFull(json& projection) {
    for (const char* key : {"offsets", "points", "mesh"})
        if (projection.contains(key)) projection[key] = kConfigs + projection[key].get<std::string>();
}

// Offsets count in pixels.
inline void shrinkOffsets(json& projection, int divisor, const TemporaryFolder& folder) {
    NumberMap map = readNumberMap(projection["offsets"]);
    for (float& value : map.values) value /= static_cast<float>(divisor);
    projection["offsets"] = folder.write("offsets.pfm", pfmBytes(map));
}

inline void shrink(json& display, int divisor, const TemporaryFolder& folder) {
    json& projection = display["projection"];
    nameMapsInFull(projection);
    if (projection["type"] == "camera_texture") shrinkOffsets(projection, divisor, folder);
    for (json& side : display["size"]) side = side.get<int>() / divisor;
    if (projection["type"] != "camera") return;
    for (json& focal : projection["focal_px"]) divide(focal, divisor);
    // Centres of pixels are at whole numbers.
    for (json& principal : projection["principal_px"])
        principal = (principal.get<double>() + 0.5) / divisor - 0.5;
}

}  // namespace small_walls

inline Wall smallShippedWall(const std::string& stem, int divisor) {
    std::ifstream file(small_walls::kConfigs + stem + ".json");
    nlohmann::json wall = nlohmann::json::parse(file);
    const TemporaryFolder folder;
    for (nlohmann::json& display : wall["displays"]) small_walls::shrink(display, divisor, folder);
    return readWall(folder.write("wall.json", wall.dump()));
}

}  // namespace curvewall::test
