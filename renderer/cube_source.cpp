#include "renderer/cube_source.h"

#include "calibration/errors.h"
#include "calibration/parallel.h"
#include "renderer/request_limits.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>

namespace curvewall {
namespace {

using CubeAxes = std::array<FaceAxes, 6>;

const FaceAxes kWallAxes{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}};

CubeAxes cubeAround(const FaceAxes& base) {
    const auto& [right, down, ahead] = base;
    return {{{-ahead, down, right},
             {ahead, down, -right},
             {right, ahead, -down},
             {right, -ahead, down},
             {-right, down, -ahead},
             {right, down, ahead}}};
}

// What the display sees of a face, on the plane at distance one.
struct SeenOfFace {
    glm::dvec2 from{std::numeric_limits<double>::infinity()};
    glm::dvec2 to{-std::numeric_limits<double>::infinity()};

    bool isSeen() const { return from.x <= to.x; }
    void add(glm::dvec2 place) {
        from = glm::min(from, place);
        to = glm::max(to, place);
    }
    void add(const SeenOfFace& other) {
        from = glm::min(from, other.from);
        to = glm::max(to, other.to);
    }
};
using SeenOfCube = std::array<SeenOfFace, 6>;

void addTo(SeenOfCube& seen, const CubeAxes& axes, glm::dvec3 ray) {
    const size_t face = mostAhead(axes, ray);
    seen[face].add(onPlane(axes[face], ray));
}

SeenOfCube seenOf(const PixelRays& rays, const CubeAxes& axes) {
    SeenOfCube all;
    std::mutex mutex;
    parallelRanges(rays.sizePx().y, [&](int begin, int end) {
        SeenOfCube some;
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < rays.sizePx().x; ++x)
                if (const glm::dvec3 ray = rays.at({x, y}); PixelRays::isRay(ray)) addTo(some, axes, ray);
        const std::scoped_lock lock(mutex);
        for (size_t i = 0; i < all.size(); ++i) all[i].add(some[i]);
    });
    return all;
}

std::optional<double> stepOnCube(const PixelRays& rays, glm::ivec2 px, const CubeAxes& axes) {
    return stepAt(rays, px, [&](glm::dvec3 ray) { return &axes[mostAhead(axes, ray)]; });
}

int faceSizeFor(std::vector<double> steps) {
    const std::optional<double> least = leastStep(std::move(steps));
    if (!least) return kLeastFacePx;
    // Rounding must not make a face that fits exactly one step larger.
    const double sizePx = (2 - 1e-6) / std::max(*least, 1.0 / kMostAutomaticFacePx);
    return std::clamp(static_cast<int>(std::ceil(sizePx / 16)) * 16, kLeastFacePx, kMostAutomaticFacePx);
}

int faceSizeFor(const PixelRays& rays, const CubeAxes& axes) {
    const auto width = static_cast<size_t>(rays.sizePx().x);
    std::vector<double> steps(width * static_cast<size_t>(rays.sizePx().y),
                              std::numeric_limits<double>::quiet_NaN());
    parallelRanges(rays.sizePx().y, [&](int begin, int end) {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < rays.sizePx().x; ++x)
                if (const auto step = stepOnCube(rays, {x, y}, axes))
                    steps[static_cast<size_t>(y) * width + static_cast<size_t>(x)] = *step;
    });
    std::erase_if(steps, [](double step) { return std::isnan(step); });
    return faceSizeFor(std::move(steps));
}

// About how many texels a cube needs, from a few pixels of the display.
double texelsNeeded(const PixelRays& rays, const std::vector<glm::ivec2>& pixels, const CubeAxes& axes,
                    int faceSizePx) {
    SeenOfCube seen;
    std::vector<double> steps;
    for (const glm::ivec2 px : pixels) {
        const glm::dvec3 ray = rays.at(px);
        if (!PixelRays::isRay(ray)) continue;
        addTo(seen, axes, ray);
        if (const auto step = stepOnCube(rays, px, axes)) steps.push_back(*step);
    }
    const double perUnit = (faceSizePx > 0 ? faceSizePx : faceSizeFor(std::move(steps))) / 2.0;
    double texels = 0;
    for (const SeenOfFace& face : seen) {
        if (!face.isSeen()) continue;
        const glm::dvec2 sizePx = perUnit * (face.to - face.from) + 2.0 * kApronPx;
        texels += sizePx.x * sizePx.y;
    }
    return texels;
}

// In whole texels of the whole face, so that its size alone says where they lie.
SourceFace faceFor(const FaceAxes& axes, const SeenOfFace& seen, int faceSizePx) {
    const double texel = 2.0 / faceSizePx;
    constexpr double kRounding = 1e-6;
    const glm::dvec2 first = glm::floor((seen.from + 1.0) / texel + kRounding);
    const glm::dvec2 end = glm::max(glm::ceil((seen.to + 1.0) / texel - kRounding), first + 1.0);
    return {axes, -1.0 + texel * (first - 1.0 * kApronPx), texel, glm::ivec2(end - first) + 2 * kApronPx};
}

ImageSource sourceOn(const PixelRays& rays, const FaceAxes& base, int faceSizePx) {
    const CubeAxes axes = cubeAround(base);
    ImageSource source{faceSizePx > 0 ? faceSizePx : faceSizeFor(rays, axes), {}};
    const SeenOfCube seen = seenOf(rays, axes);
    for (size_t i = 0; i < seen.size(); ++i)
        if (seen[i].isSeen()) source.faces.push_back(faceFor(axes[i], seen[i], source.faceSizePx));
    return source;
}

glm::dvec3 meanDirection(const PixelRays& rays) {
    glm::dvec3 sum(0);
    double count = 0;
    for (int y = 0; y < rays.sizePx().y; ++y)
        for (int x = 0; x < rays.sizePx().x; ++x)
            if (const glm::dvec3 ray = rays.at({x, y}); PixelRays::isRay(ray)) {
                sum += glm::normalize(ray);
                ++count;
            }
    return sum / std::max(count, 1.0);
}

// Where the display's rows go.
glm::dvec3 rightOf(const PixelRays& rays, const std::vector<glm::ivec2>& pixels, glm::dvec3 ahead) {
    glm::dvec3 sum(0);
    for (const glm::ivec2 px : pixels) {
        if (px.x + 1 >= rays.sizePx().x) continue;
        const glm::dvec3 ray = rays.at(px), next = rays.at(px + glm::ivec2(1, 0));
        if (PixelRays::isRay(ray) && PixelRays::isRay(next))
            sum += glm::normalize(next) - glm::normalize(ray);
    }
    constexpr double kShortest = 0.1;
    const glm::dvec3 across = sum - glm::dot(sum, ahead) * ahead;
    return glm::length(across) > kShortest * glm::length(sum) && glm::length(sum) > 0 ? across : aside(ahead);
}

std::vector<glm::ivec2> someOf(const PixelRays& rays) { return latticeOf(rays.sizePx(), {64, 64}); }

bool holdsAll(const PixelRays& rays, glm::dvec3 ahead) {
    constexpr double kBehind = -1e-3;
    if (!(glm::length(ahead) > 0)) return false;
    const glm::dvec3 axis = glm::normalize(ahead);
    for (int y = 0; y < rays.sizePx().y; ++y)
        for (int x = 0; x < rays.sizePx().x; ++x)
            if (const glm::dvec3 ray = rays.at({x, y}); PixelRays::isRay(ray))
                if (glm::dot(ray, axis) < kBehind * glm::length(ray)) return false;
    return true;
}

}  // namespace

ImageSource cubeSource(const PixelRays& rays, int faceSizePx) {
    const std::vector<glm::ivec2> lattice = someOf(rays);
    std::vector<FaceAxes> candidates{kWallAxes};
    const glm::dvec3 mean = meanDirection(rays);
    constexpr double kTellsADirection = 0.01, kEighth = std::numbers::pi / 4;
    if (glm::length(mean) > kTellsADirection) {
        const FaceAxes square = axesAround(mean, rightOf(rays, lattice, glm::normalize(mean)));
        candidates.push_back(square);
        for (const TurnAround around : {TurnAround::ahead, TurnAround::down, TurnAround::right})
            candidates.push_back(turned(square, around, kEighth));
    }
    // A few texels are not worth another orientation, and what some pixels say is not exact.
    constexpr double kWorthIt = 0.95;
    FaceAxes best = candidates.front();
    double least = std::numeric_limits<double>::infinity();
    for (const FaceAxes& candidate : candidates) {
        const double texels = texelsNeeded(rays, lattice, cubeAround(candidate), faceSizePx);
        if (texels >= kWorthIt * least) continue;
        least = texels;
        best = candidate;
    }
    return sourceOn(rays, best, faceSizePx);
}

ImageSource hemicubeSource(const PixelRays& rays, int faceSizePx) {
    const std::vector<glm::ivec2> lattice = someOf(rays);
    const std::vector<glm::dvec3> directions = directionsOf(rays, lattice);
    if (directions.empty()) return {faceSizePx > 0 ? faceSizePx : kLeastFacePx, {}};
    glm::dvec3 ahead = meanDirection(rays);
    if (!holdsAll(rays, ahead)) ahead = axisOf(directions);
    if (!holdsAll(rays, ahead))
        throw UsageError(
            "a hemicube holds what lies within 90 degrees of its axis, and this display shows "
            "more; the cube source holds it");
    ahead = glm::normalize(ahead);
    return sourceOn(rays, axesAround(ahead, rightOf(rays, lattice, ahead)), faceSizePx);
}

}  // namespace curvewall
