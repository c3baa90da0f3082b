#include "report/hard_cases/case_walls.h"

#include "calibration/formats/map_calibration.h"
#include "calibration/projections/frustum.h"
#include "calibration/readers/wall_reader.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

namespace curvewall::hard_cases {

using nlohmann::json;

WallPtr wallOf(const json& projection, glm::ivec2 sizePx, glm::dvec3 eyeM) {
    const json wall = {
        {"wall", "hard case"},
        {"eye", {eyeM.x, eyeM.y, eyeM.z}},
        {"background", {0.02, 0.03, 0.06}},
        {"displays", {{{"name", "display"}, {"size", {sizePx.x, sizePx.y}}, {"projection", projection}}}}};
    return std::make_shared<const Wall>(readWallFile({"wall.json", wall.dump()}));
}

WallPtr fisheyeWall(const char* model, double fovDeg, glm::ivec2 sizePx) {
    return wallOf({{"type", "radial"}, {"model", model}, {"fov_deg", fovDeg}}, sizePx);
}

WallPtr fullCylinderWall(glm::ivec2 sizePx, glm::dvec3 eyeM) {
    const double radiusM = 2, heightM = radiusM * 2 * std::numbers::pi * sizePx.y / sizePx.x;
    return wallOf({{"type", "cylinder"}, {"radius", radiusM}, {"arc_deg", 360}, {"height", heightM}}, sizePx,
                  eyeM);
}

WallPtr panoramaWall(glm::ivec2 sizePx) {
    return wallOf({{"type", "equirectangular"}, {"horizontal_fov_deg", 360}, {"vertical_fov_deg", 180}},
                  sizePx);
}

WallPtr measuredWall(glm::ivec2 nodes, const OffsetPx& offsetPx, glm::ivec2 sizePx) {
    NumberMap map{nodes, 2, false, {}};
    for (int y = 0; y < nodes.y; ++y)
        for (int x = 0; x < nodes.x; ++x) {
            const glm::dvec2 offset = offsetPx(glm::dvec2(x, y) / glm::dvec2(nodes - 1)) / glm::dvec2(sizePx);
            map.values.push_back(static_cast<float>(offset.x));
            map.values.push_back(static_cast<float>(offset.y));
        }
    MapMeaning meaning;
    meaning.alignment = Alignment::corners;
    meaning.isOffset = true;
    const double side = std::numbers::pi / 4, up = std::atan(static_cast<double>(sizePx.y) / sizePx.x);
    const SourcePicture source{
        glm::dvec2(sizePx),
        std::make_shared<FrustumProjection>(Frustum{-side, side, -up, up, {}}, glm::dvec2(sizePx))};
    Wall wall{"hard case", {}, {0.02f, 0.03f, 0.06f}};
    wall.displays.push_back({"display", sizePx, "camera_texture",
                             projectionOfMap(map, meaning, sizePx, source, "measured offsets")});
    return std::make_shared<const Wall>(std::move(wall));
}

}  // namespace curvewall::hard_cases
