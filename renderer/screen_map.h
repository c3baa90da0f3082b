#pragma once
// A display's projection for shaders/screen_position.glsl: which of its formulas, with what numbers, or a
// table of positions where there is no formula.

#include "calibration/pieces/pixel_rays.h"
#include "calibration/wall.h"
#include "renderer/gl/gl_handle.h"

#include <glm/vec4.hpp>

#include <array>
#include <string>
#include <vector>

namespace curvewall {

// As shaders/screen_map.glsl declares it, in the same order.
struct ScreenMapNumbers {
    std::array<glm::vec4, 3> displayFromWall{};
    glm::vec4 eyeOnSurface{0}, lensOnSurface{0};
    glm::vec4 pixels{0};
    glm::vec4 limit{0};
    std::array<glm::vec4, 3> terms{}, tilt{};
    glm::vec4 tableBox{0}, beyondTable{0};
    glm::vec4 seenCone{0};
    std::array<glm::vec4, 2> torn{};
    glm::vec4 size{0};
    glm::vec4 finish{0};
};
static_assert(sizeof(ScreenMapNumbers) == 20 * sizeof(glm::vec4));

struct ScreenMap {
    std::vector<std::string> defines;  // what the shaders are compiled with
    ScreenMapNumbers numbers;
    glm::ivec2 tableNodes{0};
    std::vector<glm::vec2> table;  // pixels, row by row; empty where a formula tells
};

// Throws UsageError where the display shows directions at several places, or tears its picture.
ScreenMap screenMapOf(const Display& display, const PixelRays& rays);

struct GpuScreenMap {
    std::vector<std::string> defines;
    ScreenMapNumbers numbers;
    GlTexture table;  // zero where there is none
};

GpuScreenMap uploadScreenMap(const ScreenMap& map);

}  // namespace curvewall
