#pragma once
// The wall files in configs/.

#include "calibration/readers/wall_reader.h"

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace curvewall::test {

inline Wall shippedWall(const std::string& stem) {
    return readWall(CURVEWALL_SOURCE_DIR "/configs/" + stem + ".json");
}

// By name, without ".json".
inline std::vector<std::string> shippedWallNames() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(CURVEWALL_SOURCE_DIR "/configs")) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() == ".json" && name != "daemon" && name != "wall.schema")
            names.push_back(name);
    }
    std::ranges::sort(names);
    return names;
}

}  // namespace curvewall::test
