#include "calibration/writers/map_conversion.h"

#include "calibration/pieces/pixel_rays.h"

#include <cmath>
#include <limits>

namespace curvewall {
namespace {

// value(node, ray) for every node with a ray, with as many numbers as there are channels.
template <class Value>
NumberMap mapOf(const RayGrid& grid, int channels, const Value& value) {
    NumberMap map{grid.nodes, channels, false, {}};
    map.values.assign(grid.rays.size() * static_cast<size_t>(channels),
                      std::numeric_limits<float>::quiet_NaN());
    size_t at = 0;
    for (int y = 0; y < grid.nodes.y; ++y)
        for (int x = 0; x < grid.nodes.x; ++x, ++at) {
            if (!PixelRays::isRay(grid.rays[at])) continue;
            const auto numbers = value(glm::ivec2(x, y), grid.rays[at]);
            for (int c = 0; c < channels; ++c)
                map.values[at * static_cast<size_t>(channels) + static_cast<size_t>(c)] =
                    static_cast<float>(numbers[c]);
        }
    return map;
}

}  // namespace

NumberMap surfacePoints(const RayGrid& grid, glm::dvec3 eyeM, glm::dvec3 originM) {
    return mapOf(grid, 3, [&](glm::ivec2 /*node*/, glm::dvec3 ray) { return eyeM + ray - originM; });
}

NumberMap imageOffsets(const RayGrid& grid, const Frustum& frustum, glm::ivec2 sizePx) {
    const FrustumProjection image(frustum, sizePx);
    return mapOf(grid, 2, [&](glm::ivec2 node, glm::dvec3 ray) {
        return image.project(ray).at(0) - grid.positionPx(node, sizePx);
    });
}

NumberMap imageFractions(const RayGrid& grid, const Frustum& frustum) {
    const FrustumProjection image(frustum, glm::dvec2(1));
    return mapOf(grid, 3, [&](glm::ivec2 /*node*/, glm::dvec3 ray) {
        return glm::dvec3(image.project(ray).at(0), 0);
    });
}

}  // namespace curvewall
