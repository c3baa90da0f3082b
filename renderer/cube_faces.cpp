#include "renderer/cube_faces.h"

#include "calibration/parallel.h"
#include "calibration/pieces/ownership.h"
#include "calibration/pieces/pixel_rays.h"
#include "renderer/request_limits.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvewall {
namespace {

struct FaceAxes {
    glm::dvec3 right, down, ahead;
};

const std::array<FaceAxes, 6> kFaces{{{{0, 0, -1}, {0, -1, 0}, {1, 0, 0}},
                                      {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
                                      {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                      {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                      {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
                                      {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}}};

const FaceAxes& axesOf(int face) { return kFaces[static_cast<size_t>(face)]; }

bool isRay(const glm::vec4& ray) { return ray.w != 0; }

// The densest pixels that a face need not resolve: at the pole of a map of longitudes density has no bound.
constexpr double kDenseShare = 0.01;

}  // namespace

std::vector<glm::vec4> displayRays(const Display& display) {
    const PixelRays exact(*display.projection, display.sizePx);
    const auto width = static_cast<size_t>(display.sizePx.x);
    std::vector<glm::vec4> rays(width * static_cast<size_t>(display.sizePx.y));
    parallelRanges(display.sizePx.y, [&](int begin, int end) {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < display.sizePx.x; ++x)
                if (const glm::dvec3 ray = exact.at({x, y}); PixelRays::isRay(ray))
                    rays[static_cast<size_t>(y) * width + static_cast<size_t>(x)] =
                        glm::vec4(glm::vec3(glm::normalize(ray)), 1);
    });
    return rays;
}

int cubeFaceOf(glm::vec3 ray) {
    const glm::vec3 size = glm::abs(ray);
    if (size.x >= size.y && size.x >= size.z) return ray.x > 0 ? 0 : 1;
    if (size.y >= size.z) return ray.y > 0 ? 2 : 3;
    return ray.z > 0 ? 4 : 5;
}

glm::dvec2 cubeFacePosition(glm::dvec3 ray, int face) {
    const FaceAxes& axes = axesOf(face);
    const glm::dvec2 offset(glm::dot(ray, axes.right), glm::dot(ray, axes.down));
    return 0.5 + 0.5 * offset / glm::dot(ray, axes.ahead);
}

glm::dvec3 cubeFaceRay(glm::dvec2 position, int face) {
    const FaceAxes& axes = axesOf(face);
    return axes.ahead + (2 * position.x - 1) * axes.right + (2 * position.y - 1) * axes.down;
}

PieceMesh cubeFaceMesh(int face, int faceSizePx, double distanceM) {
    std::vector<PieceVertex> vertices;
    for (int row = 0; row < 2; ++row)
        for (int column = 0; column < 2; ++column)
            vertices.push_back({distanceM * cubeFaceRay({column, row}, face),
                                glm::dvec2(column, row) * static_cast<double>(faceSizePx)});
    return meshFromGrid({glm::ivec2(faceSizePx), 1, 1, std::move(vertices)}, true);
}

int faceSizeFor(const Display& display, const std::vector<glm::vec4>& rays) {
    std::vector<float> steps;  // of a face's width, from each pixel to the nearer of its neighbours
    const auto width = static_cast<size_t>(display.sizePx.x);
    for (size_t i = 0; i < rays.size(); ++i) {
        float least = 2;
        const auto stepTo = [&](size_t next) {
            const int face = cubeFaceOf(rays[i]);
            if (!isRay(rays[next]) || cubeFaceOf(rays[next]) != face) return;
            const glm::dvec2 step = cubeFacePosition(rays[next], face) - cubeFacePosition(rays[i], face);
            least = std::min(least, static_cast<float>(glm::length(step)));
        };
        if (!isRay(rays[i])) continue;
        if ((i + 1) % width != 0) stepTo(i + 1);
        if (i + width < rays.size()) stepTo(i + width);
        steps.push_back(least);
    }
    if (steps.empty()) return kLeastFacePx;
    const auto dense = steps.begin() + static_cast<std::ptrdiff_t>(kDenseShare * double(steps.size() - 1));
    std::nth_element(steps.begin(), dense, steps.end());
    // Rays are single precision, so a step is known to about a thousandth.
    const double sizePx = 0.999 / std::max<double>(*dense, 0.5 / kMostAutomaticFacePx);
    return std::clamp(static_cast<int>(std::ceil(sizePx / 16)) * 16, kLeastFacePx, kMostAutomaticFacePx);
}

std::array<bool, 6> facesSeen(const std::vector<glm::vec4>& rays, int faceSizePx) {
    // A ray within a texel of a face's border reads its neighbour too.
    const auto nearest = static_cast<float>(1 - 2.0 / faceSizePx);
    std::array<bool, 6> seen{};
    for (const glm::vec4& ray : rays) {
        if (!isRay(ray)) continue;
        const float largest = std::max({std::abs(ray.x), std::abs(ray.y), std::abs(ray.z)});
        for (int axis = 0; axis < 3; ++axis) {
            const int face = 2 * axis + (ray[axis] > 0 ? 0 : 1);
            if (std::abs(ray[axis]) >= nearest * largest) seen[static_cast<size_t>(face)] = true;
        }
    }
    return seen;
}

Certificate cubeError(const Display& display, const std::vector<glm::vec4>& rays, int faceSizePx) {
    std::vector<float> errors(rays.size(), std::numeric_limits<float>::quiet_NaN());
    const std::vector<int32_t> owners(rays.size(), 0);
    const glm::ivec2 sizePx = display.sizePx;
    const bool closed = closesOnItself(display);
    parallelRanges(sizePx.y, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < sizePx.x; ++x) {
                const size_t i =
                    static_cast<size_t>(y) * static_cast<size_t>(sizePx.x) + static_cast<size_t>(x);
                if (!isRay(rays[i])) continue;
                const int face = cubeFaceOf(rays[i]);
                const glm::dvec2 texel =
                    glm::floor(cubeFacePosition(rays[i], face) * static_cast<double>(faceSizePx));
                const glm::dvec3 shown = cubeFaceRay((texel + 0.5) / static_cast<double>(faceSizePx), face);
                double least = std::numeric_limits<double>::infinity();
                for (glm::dvec2 px : display.projection->project(shown)) {
                    glm::dvec2 offset = glm::abs(px - glm::dvec2(x + 0.5, y + 0.5));
                    if (closed) offset.x = std::min(offset.x, std::abs(sizePx.x - offset.x));
                    least = std::min(least, glm::length(offset));
                }
                // Beyond the display's edge no pixel sees the texel's ray.
                if (std::isfinite(least)) errors[i] = static_cast<float>(least);
            }
        }
    });
    return certificateOf(errors, owners, sizePx);
}

}  // namespace curvewall
