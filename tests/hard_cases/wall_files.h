#pragma once
// Walls of one display, as their file says it, and the maps that such files name.

#include "calibration/files/map_file.h"
#include "calibration/readers/wall_reader.h"
#include "tests/support/map_writer.h"
#include "tests/support/temporary_folder.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <string>

namespace curvewall::test {

inline constexpr glm::vec3 kBackground(0.25f, 0.5f, 1);

inline Wall readWallOf(const TemporaryFolder& folder, const nlohmann::json& projection, glm::ivec2 sizePx,
                       glm::dvec3 eyeM = {}) {
    const nlohmann::json wall = {
        {"wall", "test"},
        {"eye", {eyeM.x, eyeM.y, eyeM.z}},
        {"background", {kBackground.r, kBackground.g, kBackground.b}},
        {"displays", {{{"name", "only"}, {"size", {sizePx.x, sizePx.y}}, {"projection", projection}}}}};
    return readWall(folder.write("wall.json", wall.dump()));
}

// Numbers at the nodes of a grid; rowwise from the top, positions from 0 to 1.
using NumbersAt = std::function<glm::dvec3(glm::dvec2)>;

inline NumberMap mapOf(glm::ivec2 nodes, bool atCorners, const NumbersAt& numbersAt) {
    NumberMap map{nodes, 3, false, {}};
    for (int y = 0; y < nodes.y; ++y) {
        for (int x = 0; x < nodes.x; ++x) {
            const glm::dvec2 at = atCorners ? glm::dvec2(x, y) / glm::dvec2(nodes - 1)
                                            : (glm::dvec2(x, y) + 0.5) / glm::dvec2(nodes);
            const glm::dvec3 numbers = numbersAt(at);
            for (int c = 0; c < 3; ++c) map.values.push_back(static_cast<float>(numbers[c]));
        }
    }
    return map;
}

inline nlohmann::json cameraTexture(const std::string& file, const std::string& direction,
                                    const std::string& alignment = "corners") {
    return {{"type", "camera_texture"},
            {"base", {{"left_deg", -45}, {"right_deg", 45}, {"down_deg", -36.87}, {"up_deg", 36.87}}},
            {"offsets", file},
            {"direction", direction},
            {"semantics", "offset"},
            {"alignment", alignment},
            {"origin", "top_left"},
            {"units", "px"}};
}

inline nlohmann::json surfaceMap(const std::string& file, const std::string& alignment = "corners") {
    return {{"type", "surface_map"},
            {"points", file},
            {"units", "m"},
            {"alignment", alignment},
            {"origin", "top_left"}};
}

}  // namespace curvewall::test
