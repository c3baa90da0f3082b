#include "renderer/image_source.h"

#include "calibration/parallel.h"
#include "renderer/request_limits.h"
#include "renderer/shown_error.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace curvewall {
namespace {

const std::array<FaceAxes, 6> kCubeAxes{{{{0, 0, 1}, {0, -1, 0}, {1, 0, 0}},
                                         {{0, 0, -1}, {0, -1, 0}, {-1, 0, 0}},
                                         {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                         {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                         {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
                                         {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}};

glm::dvec2 onPlane(const FaceAxes& axes, glm::dvec3 ray) {
    return glm::dvec2(glm::dot(ray, axes.right), glm::dot(ray, axes.down)) / glm::dot(ray, axes.ahead);
}

size_t cubeFaceOf(glm::dvec3 ray) {
    const glm::dvec3 size = glm::abs(ray);
    if (size.x >= size.y && size.x >= size.z) return ray.x > 0 ? 0 : 1;
    if (size.y >= size.z) return ray.y > 0 ? 2 : 3;
    return ray.z > 0 ? 4 : 5;
}

size_t pixelCount(glm::ivec2 sizePx) { return static_cast<size_t>(sizePx.x) * static_cast<size_t>(sizePx.y); }

void forEachRay(const PixelRays& rays, const std::function<void(glm::ivec2, size_t, glm::dvec3)>& work) {
    const glm::ivec2 sizePx = rays.sizePx();
    parallelRanges(sizePx.y, [&](int begin, int end) {
        auto index = static_cast<size_t>(begin) * static_cast<size_t>(sizePx.x);
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < sizePx.x; ++x, ++index)
                if (const glm::dvec3 ray = rays.at({x, y}); PixelRays::isRay(ray)) work({x, y}, index, ray);
    });
}

int cubeFaceSizeFor(const PixelRays& rays) {
    std::vector<double> steps(pixelCount(rays.sizePx()), std::numeric_limits<double>::quiet_NaN());
    forEachRay(rays, [&](glm::ivec2 px, size_t index, glm::dvec3) {
        const auto step = stepAt(rays, px, [](glm::dvec3 ray) { return &kCubeAxes[cubeFaceOf(ray)]; });
        if (step) steps[index] = *step;
    });
    std::erase_if(steps, [](double step) { return std::isnan(step); });
    const std::optional<double> least = leastStep(std::move(steps));
    if (!least) return kLeastFacePx;
    // Rounding must not make a face that fits exactly one step larger.
    const double sizePx = (2 - 1e-6) / std::max(*least, 1.0 / kMostAutomaticFacePx);
    return std::clamp(static_cast<int>(std::ceil(sizePx / 16)) * 16, kLeastFacePx, kMostAutomaticFacePx);
}

std::array<bool, 6> cubeFacesSeen(const PixelRays& rays) {
    std::array<bool, 6> seen{};
    for (int y = 0; y < rays.sizePx().y; ++y)
        for (int x = 0; x < rays.sizePx().x; ++x)
            if (const glm::dvec3 ray = rays.at({x, y}); PixelRays::isRay(ray)) seen[cubeFaceOf(ray)] = true;
    return seen;
}

}  // namespace

glm::dvec2 SourceFace::place(glm::dvec3 ray) const { return (onPlane(axes, ray) - from) / texel; }

glm::dvec3 SourceFace::ray(glm::dvec2 place) const {
    const glm::dvec2 at = from + texel * place;
    return axes.ahead + at.x * axes.right + at.y * axes.down;
}

size_t faceOf(const ImageSource& source, glm::dvec3 ray) {
    size_t best = 0;
    for (size_t i = 1; i < source.faces.size(); ++i)
        if (glm::dot(ray, source.faces[i].axes.ahead) > glm::dot(ray, source.faces[best].axes.ahead))
            best = i;
    return best;
}

std::optional<double> stepAt(const PixelRays& rays, glm::ivec2 px, const AxesOfRay& axesOf) {
    const glm::dvec3 ray = rays.at(px);
    if (!PixelRays::isRay(ray)) return std::nullopt;
    const FaceAxes* axes = axesOf(ray);
    if (!axes) return std::nullopt;
    std::optional<double> least;
    for (const glm::ivec2 next : {px + glm::ivec2(1, 0), px + glm::ivec2(0, 1)}) {
        if (next.x >= rays.sizePx().x || next.y >= rays.sizePx().y) continue;
        const glm::dvec3 neighbour = rays.at(next);
        if (!PixelRays::isRay(neighbour) || axesOf(neighbour) != axes) continue;
        const double step = glm::distance(onPlane(*axes, ray), onPlane(*axes, neighbour));
        least = std::min(step, least.value_or(step));
    }
    return least;
}

std::optional<double> leastStep(std::vector<double> steps) {
    constexpr double kShortest = 0.01;
    if (steps.empty()) return std::nullopt;
    const auto least = steps.begin() + static_cast<std::ptrdiff_t>(kShortest * double(steps.size() - 1));
    std::nth_element(steps.begin(), least, steps.end());
    return *least;
}

ImageSource cubeSource(const PixelRays& rays, int faceSizePx) {
    ImageSource source{faceSizePx > 0 ? faceSizePx : cubeFaceSizeFor(rays), {}};
    const std::array<bool, 6> seen = cubeFacesSeen(rays);
    const double texel = 2.0 / source.faceSizePx;
    for (size_t i = 0; i < seen.size(); ++i)
        if (seen[i])
            source.faces.push_back({kCubeAxes[i], glm::dvec2(-1 - kApronPx * texel), texel,
                                    glm::ivec2(source.faceSizePx + 2 * kApronPx)});
    return source;
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

Certificate sourceError(const ImageSource& source, const Display& display, const PixelRays& rays) {
    std::vector<float> errors(pixelCount(display.sizePx), std::numeric_limits<float>::quiet_NaN());
    const std::vector<int32_t> owners(errors.size(), 0);
    const PixelDistance distance(display);
    forEachRay(rays, [&](glm::ivec2 px, size_t index, glm::dvec3 ray) {
        const SourceFace& face = source.faces[faceOf(source, ray)];
        const glm::dvec3 shown = face.ray(glm::floor(face.place(ray)) + 0.5);
        // Beyond the display's edge no pixel sees the texel's ray.
        if (const auto error = distance.from(centreOf(px), shown)) errors[index] = static_cast<float>(*error);
    });
    return certificateOf(errors, owners, display.sizePx);
}

}  // namespace curvewall
