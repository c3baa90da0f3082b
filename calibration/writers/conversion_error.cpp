#include "calibration/writers/conversion_error.h"

#include "calibration/parallel.h"
#include "calibration/pieces/pixel_rays.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace curvewall {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// In which each pixel may be.
enum class Pixel : uint8_t { hole, gainedHole, lostHole, seen };

struct Measured {
    std::vector<double> errorsPx;  // row by row, 0 where nothing is compared
    std::vector<Pixel> pixels;
};

double distancePx(const Display& original, const PixelRays& rays, bool isFullTurn, glm::ivec2 px,
                  glm::dvec3 ray) {
    double nearest = kInfinity;
    for (const glm::dvec2 shown : original.projection->project(ray)) {
        glm::dvec2 off = glm::abs(shown - centreOf(px));
        if (isFullTurn) off.x = std::min(off.x, std::abs(original.sizePx.x - off.x));
        nearest = std::min(nearest, glm::length(off));
    }
    // A grid answers nothing beyond its border, where a ray that is a millionth of a pixel off may fall.
    if (nearest == kInfinity)
        if (const auto off = rays.offsetPx(px, ray)) nearest = glm::length(*off);
    return nearest;
}

Measured measure(const Display& original, const Display& converted) {
    const glm::ivec2 sizePx = original.sizePx;
    const auto count = static_cast<size_t>(sizePx.x) * static_cast<size_t>(sizePx.y);
    Measured measured{std::vector<double>(count), std::vector<Pixel>(count)};
    const PixelRays before(*original.projection, sizePx), after(*converted.projection, sizePx);
    const bool isFullTurn = closesOnItself(original);
    parallelRanges(sizePx.y, [&](int begin, int end) {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < sizePx.x; ++x) {
                const glm::ivec2 px(x, y);
                const size_t at =
                    static_cast<size_t>(y) * static_cast<size_t>(sizePx.x) + static_cast<size_t>(x);
                const glm::dvec3 ray = after.at(px);
                const bool had = before.has(px), has = PixelRays::isRay(ray);
                measured.pixels[at] =
                    had ? (has ? Pixel::seen : Pixel::gainedHole) : (has ? Pixel::lostHole : Pixel::hole);
                if (had && has) measured.errorsPx[at] = distancePx(original, before, isFullTurn, px, ray);
            }
    });
    return measured;
}

glm::vec3 valueAt(const std::vector<glm::vec3>& map, size_t pixel, float otherwise) {
    return map.empty() ? glm::vec3(otherwise) : map[pixel];
}

// Holes show no picture, so that it does not matter what blends it.
double blendDifference(const Display& original, const Display& converted, const std::vector<Pixel>& pixels) {
    const BlendMaps none, &before = original.blend ? *original.blend : none,
                          &after = converted.blend ? *converted.blend : none;
    float largest = 0;
    for (size_t i = 0; i < pixels.size(); ++i) {
        if (pixels[i] != Pixel::seen) continue;
        const glm::vec3 off = glm::max(glm::abs(valueAt(before.alpha, i, 1) - valueAt(after.alpha, i, 1)),
                                       glm::abs(valueAt(before.beta, i, 0) - valueAt(after.beta, i, 0)));
        largest = std::max({largest, off.x, off.y, off.z});
    }
    return largest;
}

}  // namespace

ConversionError conversionError(const Display& original, const Display& converted) {
    const Measured measured = measure(original, converted);
    ConversionError error;
    std::vector<double> errorsPx;
    const int width = original.sizePx.x;
    for (size_t i = 0; i < measured.pixels.size(); ++i) {
        error.holesGained += measured.pixels[i] == Pixel::gainedHole;
        error.holesLost += measured.pixels[i] == Pixel::lostHole;
        if (measured.pixels[i] != Pixel::seen) continue;
        errorsPx.push_back(measured.errorsPx[i]);
        error.meanPx += measured.errorsPx[i];
        if (measured.errorsPx[i] <= error.maxPx) continue;
        error.maxPx = measured.errorsPx[i];
        error.maxAt = {static_cast<int>(i) % width, static_cast<int>(i) / width};
    }
    error.blendDifference = blendDifference(original, converted, measured.pixels);
    if (errorsPx.empty()) return error;
    error.meanPx /= static_cast<double>(errorsPx.size());
    const auto p99 =
        errorsPx.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(errorsPx.size() - 1));
    std::ranges::nth_element(errorsPx, p99);
    error.p99Px = *p99;
    return error;
}

}  // namespace curvewall
