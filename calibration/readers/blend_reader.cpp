#include "calibration/readers/blend_reader.h"

#include "calibration/errors.h"
#include "calibration/files/map_file.h"
#include "calibration/parallel.h"
#include "calibration/readers/projection_fields.h"

#include <glm/exponential.hpp>

#include <cmath>
#include <string>

namespace curvewall {
namespace {

constexpr Range kGamma{0.1, 10};

std::string pixelsText(glm::ivec2 sizePx) {
    return std::to_string(sizePx.x) + " x " + std::to_string(sizePx.y) + " pixels";
}

std::string placeText(int x, int y) {
    return " at pixel (" + std::to_string(x) + ", " + std::to_string(y) + ")";
}

glm::vec3 readGamma(JsonFields& fields) {
    if (!fields.hasList("gamma"))
        return glm::vec3(static_cast<float>(fields.number("gamma", kGamma).value_or(1)));
    const auto gamma = *fields.numbers("gamma", 3, kGamma);
    return glm::vec3(gamma[0], gamma[1], gamma[2]);
}

// Programs add an opaque alpha channel to any picture; one that says something else was meant for a purpose
// that we do not know.
void requireUsableTexel(const std::string& path, const NumberMap& map, int x, int y) {
    const float* texel = map.at(x, y);
    for (int c = 0; c < map.channels; ++c)
        if (!(texel[c] >= 0 && texel[c] <= 1))  // NaN is not
            throw InputError(path, "", "values from 0 to 1", std::to_string(texel[c]) + placeText(x, y));
    const bool hasAlpha = map.channels == 2 || map.channels == 4;
    if (hasAlpha && texel[map.channels - 1] < 1)
        throw InputError(path, "", "one or three channels, or an alpha channel that is opaque everywhere",
                         "an alpha of " + std::to_string(texel[map.channels - 1]) + placeText(x, y));
}

std::vector<glm::vec3> readMap(const std::string& path, glm::vec3 gamma, glm::ivec2 sizePx) {
    const NumberMap map = readNumberMap(path);
    if (map.sizePx != sizePx)
        throw InputError(path, "", pixelsText(sizePx) + ", as the display has", pixelsText(map.sizePx));
    const bool isLinear = gamma == glm::vec3(1);
    const int green = map.channels >= 3 ? 1 : 0, blue = map.channels >= 3 ? 2 : 0;
    std::vector<glm::vec3> light(static_cast<size_t>(sizePx.x) * static_cast<size_t>(sizePx.y));
    parallelRanges(sizePx.y, [&](int begin, int end) {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < sizePx.x; ++x) {
                requireUsableTexel(path, map, x, y);
                const float* texel = map.at(x, y);
                const glm::vec3 stored(texel[0], texel[green], texel[blue]);
                light[static_cast<size_t>(y) * static_cast<size_t>(sizePx.x) + static_cast<size_t>(x)] =
                    isLinear ? stored : glm::pow(stored, gamma);
            }
    });
    return light;
}

}  // namespace

BlendMaps readBlend(JsonFields& fields, const WallFolder& folder, glm::ivec2 sizePx) {
    const auto alpha = readPath(fields, "alpha", folder), beta = readPath(fields, "beta", folder);
    const glm::vec3 gamma = readGamma(fields);
    fields.refuseUnknownKeys();
    BlendMaps maps;
    if (alpha) maps.alpha = readMap(*alpha, gamma, sizePx);
    if (beta) maps.beta = readMap(*beta, gamma, sizePx);
    return maps;
}

}  // namespace curvewall
