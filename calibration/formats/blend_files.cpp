#include "calibration/formats/blend_files.h"

#include "calibration/errors.h"
#include "calibration/files/map_file.h"
#include "calibration/parallel.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <algorithm>
#include <string>

namespace curvewall {
namespace {

bool hasAlpha(const NumberMap& map) { return map.channels == 2 || map.channels == 4; }

// Colours must lie within 0 and 1. Whether the alpha channel says something.
bool checkTexels(const std::string& path, const NumberMap& map) {
    const int colours = map.channels - (hasAlpha(map) ? 1 : 0);
    bool isTransparent = false;
    for (int y = 0; y < map.sizePx.y; ++y)
        for (int x = 0; x < map.sizePx.x; ++x) {
            const float* texel = map.at(x, y);
            for (int c = 0; c < colours; ++c)
                if (!(texel[c] >= 0 && texel[c] <= 1))  // NaN is not
                    throw InputError(path, "", "values from 0 to 1",
                                     fmt::format("{} at pixel ({}, {})", texel[c], x, y));
            isTransparent |= hasAlpha(map) && texel[colours] != 1;
        }
    return isTransparent;
}

glm::vec3 colourAt(const NumberMap& map, int x, int y) {
    const float* texel = map.at(x, y);
    return map.channels >= 3 ? glm::vec3(texel[0], texel[1], texel[2]) : glm::vec3(texel[0]);
}

// As a graphics card filters it: values at the centres of texels, and the border goes on as it is.
glm::vec3 filteredAt(const NumberMap& map, glm::dvec2 fraction) {
    const glm::ivec2 last = map.sizePx - 1;
    const glm::dvec2 texel =
        glm::clamp(fraction * glm::dvec2(map.sizePx) - 0.5, glm::dvec2(0), glm::dvec2(last));
    const glm::ivec2 low(texel), high = glm::min(low + 1, last);
    const glm::vec2 st(texel - glm::dvec2(low));
    return glm::mix(glm::mix(colourAt(map, low.x, low.y), colourAt(map, high.x, low.y), st.x),
                    glm::mix(colourAt(map, low.x, high.y), colourAt(map, high.x, high.y), st.x), st.y);
}

}  // namespace

std::vector<glm::vec3> readBlendPicture(const FileBytes& file, glm::ivec2 sizePx, double gamma,
                                        const std::string& place, Decisions& decisions, TexelBudget* budget) {
    const NumberMap map = readNumberMap(file, [&](glm::ivec2 pictureSizePx) {
        if (budget && pictureSizePx != sizePx) budget->take(pictureSizePx, place);
    });
    if (map.scale != 1)
        decisions.warn(fmt::format("{}: the scale {:g} of {} is not used", place, map.scale, file.name()));
    return linearPicture(map, file.path, sizePx, gamma, place, decisions);
}

std::vector<glm::vec3> linearPicture(const NumberMap& map, const std::string& path, glm::ivec2 sizePx,
                                     double gamma, const std::string& place, Decisions& decisions) {
    const std::string name = FileBytes{path, {}}.name();
    if (checkTexels(path, map))
        decisions.warn(fmt::format("{}: the alpha channel of {} is not used", place, name));
    if (map.sizePx != sizePx)
        decisions.warn(fmt::format("{}: {} has {} x {} pixels and the display {} x {}; it is resampled",
                                   place, name, map.sizePx.x, map.sizePx.y, sizePx.x, sizePx.y));
    std::vector<glm::vec3> light(static_cast<size_t>(sizePx.x) * static_cast<size_t>(sizePx.y));
    const glm::vec3 exponent(static_cast<float>(gamma));
    parallelRanges(sizePx.y, [&](int begin, int end) {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < sizePx.x; ++x) {
                const glm::vec3 stored =
                    map.sizePx == sizePx ? colourAt(map, x, y)
                                         : filteredAt(map, glm::dvec2(x + 0.5, y + 0.5) / glm::dvec2(sizePx));
                light[static_cast<size_t>(y) * static_cast<size_t>(sizePx.x) + static_cast<size_t>(x)] =
                    gamma == 1 ? stored : glm::pow(stored, exponent);
            }
    });
    return light;
}

}  // namespace curvewall
