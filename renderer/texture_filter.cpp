#include "renderer/texture_filter.h"

#include "renderer/image_file.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>

namespace curvewall {
namespace {

// One period of the texture (two when mirrored) before anything becomes an integer, so that no uv overflows.
double reduceCoordinate(double coordinate, Wrap wrap) {
    if (!std::isfinite(coordinate)) return 0;
    switch (wrap) {
        case Wrap::repeat:
            return coordinate - std::floor(coordinate);
        case Wrap::mirroredRepeat:
            return coordinate - 2 * std::floor(coordinate / 2);
        case Wrap::clampToEdge:
            return std::clamp(coordinate, 0.0, 1.0);
    }
    return 0;
}

// `texel` lies in [-1, 2 size].
int wrapTexel(int texel, int size, Wrap wrap) {
    switch (wrap) {
        case Wrap::repeat:
            return (texel + size) % size;
        case Wrap::mirroredRepeat: {
            const int inPeriod = (texel + 2 * size) % (2 * size);
            return inPeriod < size ? inPeriod : 2 * size - 1 - inPeriod;
        }
        case Wrap::clampToEdge:
            return std::clamp(texel, 0, size - 1);
    }
    return 0;
}

// The two texels that a coordinate lies between, and how far it is from the first.
struct Span {
    int first, second;
    float blend;
};

Span spanAt(double coordinate, int size, Wrap wrap) {
    const double texel = reduceCoordinate(coordinate, wrap) * size - 0.5;
    const int first = static_cast<int>(std::floor(texel));
    return {wrapTexel(first, size, wrap), wrapTexel(first + 1, size, wrap),
            static_cast<float>(texel - first)};
}

glm::vec4 texelAt(const MipLevel& level, int x, int y) {
    const glm::u8vec4 t =
        level.texels[static_cast<size_t>(y) * static_cast<size_t>(level.sizePx.x) + static_cast<size_t>(x)];
    return {linearFromSrgbByte(t.r), linearFromSrgbByte(t.g), linearFromSrgbByte(t.b),
            static_cast<float>(t.a) / 255.0f};
}

glm::vec4 sampleLevel(const Texture& texture, size_t index, glm::dvec2 uv) {
    const MipLevel& level = texture.levels[index];
    const Span s = spanAt(uv.x, level.sizePx.x, texture.wrapS);
    const Span t = spanAt(uv.y, level.sizePx.y, texture.wrapT);
    return glm::mix(glm::mix(texelAt(level, s.first, t.first), texelAt(level, s.second, t.first), s.blend),
                    glm::mix(texelAt(level, s.first, t.second), texelAt(level, s.second, t.second), s.blend),
                    t.blend);
}

}  // namespace

double levelOfDetail(glm::ivec2 sizePx, glm::dvec2 uvAcross, glm::dvec2 uvDown) {
    const glm::dvec2 size(sizePx);
    return std::log2(std::max(glm::length(uvAcross * size), glm::length(uvDown * size)));
}

glm::vec4 sampleTexture(const Texture& texture, glm::dvec2 uv, double levelOfDetail) {
    const auto coarsest = static_cast<double>(texture.levels.size() - 1);
    if (!(levelOfDetail > 0)) return sampleLevel(texture, 0, uv);
    if (levelOfDetail >= coarsest) return sampleLevel(texture, texture.levels.size() - 1, uv);
    const auto finer = static_cast<size_t>(levelOfDetail);
    return glm::mix(sampleLevel(texture, finer, uv), sampleLevel(texture, finer + 1, uv),
                    static_cast<float>(levelOfDetail - static_cast<double>(finer)));
}

}  // namespace curvewall
