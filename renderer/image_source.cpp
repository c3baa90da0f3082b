#include "renderer/image_source.h"

#include "calibration/parallel.h"
#include "renderer/shown_error.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvewall {
namespace {

size_t pixelCount(glm::ivec2 sizePx) { return static_cast<size_t>(sizePx.x) * static_cast<size_t>(sizePx.y); }

void forEachPixel(glm::ivec2 sizePx, const std::function<void(glm::ivec2, size_t)>& work) {
    parallelRanges(sizePx.y, [&](int begin, int end) {
        auto index = static_cast<size_t>(begin) * static_cast<size_t>(sizePx.x);
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < sizePx.x; ++x, ++index) work({x, y}, index);
    });
}

void forEachRay(const PixelRays& rays, const std::function<void(glm::ivec2, size_t, glm::dvec3)>& work) {
    forEachPixel(rays.sizePx(), [&](glm::ivec2 px, size_t index) {
        if (const glm::dvec3 ray = rays.at(px); PixelRays::isRay(ray)) work(px, index, ray);
    });
}

// The lesser singular value of the map whose columns these are.
double leastStretch(glm::dvec2 a, glm::dvec2 b) {
    const double squares = glm::dot(a, a) + glm::dot(b, b), area = std::abs(a.x * b.y - a.y * b.x);
    const double most =
        std::sqrt((squares + std::sqrt(std::max(squares * squares - 4 * area * area, 0.0))) / 2);
    return most > 0 ? area / most : 0;
}

// Where a neighbour's ray meets the plane of a face that it may lie beside. Nothing far beside it.
std::optional<glm::dvec2> placeOfNeighbour(const SourceFace& face, const PixelRays& rays, glm::ivec2 px) {
    constexpr double kLeastCosine = 0.1;
    if (px.x < 0 || px.y < 0 || px.x >= rays.sizePx().x || px.y >= rays.sizePx().y) return std::nullopt;
    const glm::dvec3 ray = rays.at(px);
    if (!PixelRays::isRay(ray)) return std::nullopt;
    if (glm::dot(ray, face.axes.ahead) < kLeastCosine * glm::length(ray)) return std::nullopt;
    return face.place(ray);
}

glm::dvec2 gradientAlong(const SourceFace& face, const PixelRays& rays, glm::ivec2 px, glm::ivec2 step) {
    const glm::dvec2 here = face.place(rays.at(px));
    const auto before = placeOfNeighbour(face, rays, px - step);
    const auto after = placeOfNeighbour(face, rays, px + step);
    if (before && after) return (*after - *before) / 2.0;
    if (after) return *after - here;
    return before ? here - *before : glm::dvec2(0);
}

// Levels whose texels are at least as wide as what all pixels but the hundredth with the most cover.
int levelsFor(const std::vector<glm::vec4>& gradients, const std::vector<glm::vec4>& places) {
    constexpr double kShare = 0.99;
    std::vector<float> widths;
    for (size_t i = 0; i < places.size(); ++i)
        if (places[i].w != 0)
            widths.push_back(std::max(glm::length(glm::vec2(gradients[i].x, gradients[i].y)),
                                      glm::length(glm::vec2(gradients[i].z, gradients[i].w))));
    if (widths.empty()) return 0;
    const auto most = widths.begin() + static_cast<std::ptrdiff_t>(kShare * double(widths.size() - 1));
    std::ranges::nth_element(widths, most);
    // Rounding must not add a level where a texel is a pixel.
    const double levels = std::ceil(std::log2(std::max(*most, 1.0f)) - 1e-3);
    return std::min(static_cast<int>(levels), kMostLevels);
}

// `shownFor` tells the place whose ray is shown for one that is looked up.
Certificate errorOfShown(const ImageSource& source, const std::vector<glm::vec4>& places,
                         const Display& display, const std::function<glm::dvec2(glm::dvec2)>& shownFor) {
    std::vector<float> errors(places.size(), std::numeric_limits<float>::quiet_NaN());
    const std::vector<int32_t> owners(places.size(), 0);
    const PixelDistance distance(display);
    forEachPixel(display.sizePx, [&](glm::ivec2 px, size_t index) {
        const glm::vec4& place = places[index];
        if (place.w == 0) return;
        const SourceFace& face = source.faces[static_cast<size_t>(place.z)];
        // Beyond the display's edge no pixel sees the ray.
        if (const auto error = distance.from(centreOf(px), face.ray(shownFor({place.x, place.y}))))
            errors[index] = static_cast<float>(*error);
    });
    return certificateOf(errors, owners, display.sizePx);
}

}  // namespace

glm::dvec2 SourceFace::place(glm::dvec3 ray) const { return (onPlane(axes, ray) - from) / texel; }

glm::dvec3 SourceFace::ray(glm::dvec2 place) const {
    const glm::dvec2 at = from + texel * place;
    return axes.ahead + at.x * axes.right + at.y * axes.down;
}

glm::dvec2 onPlane(const FaceAxes& axes, glm::dvec3 ray) {
    return glm::dvec2(glm::dot(ray, axes.right), glm::dot(ray, axes.down)) / glm::dot(ray, axes.ahead);
}

size_t mostAhead(std::span<const FaceAxes> axes, glm::dvec3 ray) {
    size_t best = 0;
    for (size_t i = 1; i < axes.size(); ++i)
        if (glm::dot(ray, axes[i].ahead) > glm::dot(ray, axes[best].ahead)) best = i;
    return best;
}

size_t faceOf(const ImageSource& source, glm::dvec3 ray) {
    size_t best = 0;
    for (size_t i = 1; i < source.faces.size(); ++i)
        if (glm::dot(ray, source.faces[i].axes.ahead) > glm::dot(ray, source.faces[best].axes.ahead))
            best = i;
    return best;
}

glm::ivec2 layerSizeOf(const ImageSource& source) {
    glm::ivec2 sizePx(1);
    for (const SourceFace& face : source.faces) sizePx = glm::max(sizePx, face.sizePx);
    const int unitPx = 1 << source.levels;
    return (sizePx + (unitPx - 1)) / unitPx * unitPx;
}

uint64_t texelCountOf(const ImageSource& source) {
    uint64_t count = 0;
    for (const SourceFace& face : source.faces) count += pixelCount(face.sizePx);
    return count;
}

std::optional<double> stepAt(const PixelRays& rays, glm::ivec2 px, const AxesOfRay& axesOf) {
    const glm::dvec3 ray = rays.at(px);
    if (!PixelRays::isRay(ray)) return std::nullopt;
    const FaceAxes* axes = axesOf(ray);
    if (!axes) return std::nullopt;
    const auto stepTo = [&](glm::ivec2 next) -> std::optional<glm::dvec2> {
        if (next.x >= rays.sizePx().x || next.y >= rays.sizePx().y) return std::nullopt;
        const glm::dvec3 neighbour = rays.at(next);
        if (!PixelRays::isRay(neighbour) || axesOf(neighbour) != axes) return std::nullopt;
        return onPlane(*axes, neighbour) - onPlane(*axes, ray);
    };
    const auto right = stepTo(px + glm::ivec2(1, 0)), below = stepTo(px + glm::ivec2(0, 1));
    if (right && below) return leastStretch(*right, *below);
    if (right) return glm::length(*right);
    if (below) return glm::length(*below);
    return std::nullopt;
}

std::optional<double> leastStep(std::vector<double> steps) {
    constexpr double kShortest = 0.01;
    if (steps.empty()) return std::nullopt;
    const auto least = steps.begin() + static_cast<std::ptrdiff_t>(kShortest * double(steps.size() - 1));
    std::nth_element(steps.begin(), least, steps.end());
    return *least;
}

PieceMesh faceMesh(const SourceFace& face, double distanceM) {
    std::vector<PieceVertex> vertices;
    for (int row = 0; row < 2; ++row) {
        for (int column = 0; column < 2; ++column) {
            const glm::dvec2 corner = glm::dvec2(column, row) * glm::dvec2(face.sizePx);
            vertices.push_back({distanceM * face.ray(corner), corner});
        }
    }
    return meshFromGrid({face.sizePx, 1, 1, std::move(vertices)}, true);
}

std::vector<glm::vec4> sourcePlaces(const ImageSource& source, const PixelRays& rays) {
    std::vector<glm::vec4> places(pixelCount(rays.sizePx()), glm::vec4(0));
    forEachRay(rays, [&](glm::ivec2, size_t index, glm::dvec3 ray) {
        const size_t face = faceOf(source, ray);
        places[index] = {glm::vec2(source.faces[face].place(ray)), face, 1};
    });
    return places;
}

std::vector<glm::vec4> sourceGradients(const ImageSource& source, const PixelRays& rays) {
    std::vector<glm::vec4> gradients(pixelCount(rays.sizePx()), glm::vec4(0));
    forEachRay(rays, [&](glm::ivec2 px, size_t index, glm::dvec3 ray) {
        const SourceFace& face = source.faces[faceOf(source, ray)];
        gradients[index] = {glm::vec2(gradientAlong(face, rays, px, {1, 0})),
                            glm::vec2(gradientAlong(face, rays, px, {0, 1}))};
    });
    return gradients;
}

ImageSource withLevels(ImageSource source, const PixelRays& rays) {
    source.levels = levelsFor(sourceGradients(source, rays), sourcePlaces(source, rays));
    // A texel of the last level that a linear filter takes in lies within one and a half of its widths from
    // the place; along the longer side of a pixel, which is at most one of its widths, within two.
    const int apronPx = std::max(kApronPx, 2 << source.levels);
    for (SourceFace& face : source.faces) {
        face.from -= face.texel * (apronPx - source.apronPx);
        face.sizePx += 2 * (apronPx - source.apronPx);
    }
    source.apronPx = apronPx;
    return source;
}

Certificate sourceError(const ImageSource& source, const std::vector<glm::vec4>& places,
                        const Display& display) {
    return errorOfShown(source, places, display, [](glm::dvec2 place) { return glm::floor(place) + 0.5; });
}

Certificate lookupError(const ImageSource& source, const std::vector<glm::vec4>& places,
                        const Display& display) {
    return errorOfShown(source, places, display, [](glm::dvec2 place) { return place; });
}

}  // namespace curvewall
