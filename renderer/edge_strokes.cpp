#include "renderer/edge_strokes.h"

#include "renderer/line_styles.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <optional>

namespace curvewall {
namespace {

// Half the distance over which the change of a ray is taken.
constexpr double kStepPx = 0.5;

// Length one, scene axes.
std::optional<glm::dvec3> directionAt(const EdgeStrokes::Eye& eye, glm::dvec2 px) {
    const std::optional<glm::dvec3> ray = eye.projection.unproject(px);
    if (!ray) return std::nullopt;
    return eye.sceneFromWall * glm::normalize(*ray);
}

// Change of the ray per pixel; at the display's end what the inner side tells.
glm::dvec3 changeOfRay(const EdgeStrokes::Eye& eye, glm::dvec2 px, glm::dvec3 ray, glm::dvec2 step) {
    const std::optional<glm::dvec3> before = directionAt(eye, px - step), after = directionAt(eye, px + step);
    if (!before && !after) return glm::dvec3(0);
    const double sides = before && after ? 2 : 1;
    return (after.value_or(ray) - before.value_or(ray)) / (sides * kStepPx);
}

}  // namespace

EdgeStrokes::EdgeStrokes(const Scene& scene, Style style)
    : scene_(scene), style_(style), neighbours_(edgeNeighbours(scene.positions, scene.triangles)) {}

float EdgeStrokes::widthPx(uint32_t triangle, int edge, glm::dvec3 edgePlane, glm::dvec3 eyeM) const {
    const EdgeNeighbour neighbour = neighbours_[3 * size_t{triangle} + static_cast<size_t>(edge)];
    const auto offPlane = [&](uint32_t vertex) {
        return glm::dot(edgePlane, glm::dvec3(scene_.positions[vertex]) - eyeM);
    };
    const bool silhouette =
        neighbour.exists() && offPlane(scene_.triangles[triangle][edge]) * offPlane(neighbour.corner) > 0;
    if (style_ == Style::wireframe) return line_styles::wireWidthPx(silhouette);
    return line_styles::outlineWidthPx(silhouette, !neighbour.exists() || neighbour.isCrease);
}

float EdgeStrokes::coverage(uint32_t triangle, const Eye& eye, glm::dvec2 px) const {
    const std::optional<glm::dvec3> ray = directionAt(eye, px);
    if (!ray) return 0;
    const glm::dvec3 across = changeOfRay(eye, px, *ray, {kStepPx, 0});
    const glm::dvec3 down = changeOfRay(eye, px, *ray, {0, kStepPx});
    const auto cornerAt = [&](int i) {
        return glm::dvec3(scene_.positions[scene_.triangles[triangle][i % 3]]) - eye.positionM;
    };
    float most = 0;
    for (int edge = 0; edge < 3; ++edge) {
        const glm::dvec3 from = cornerAt(edge + 1);
        const glm::dvec3 plane = glm::normalize(glm::cross(from, cornerAt(edge + 2) - from));
        const glm::dvec2 gradient(glm::dot(plane, across), glm::dot(plane, down));
        const float distancePx =
            line_styles::distanceToLinePx(static_cast<float>(glm::dot(plane, *ray)), glm::vec2(gradient));
        most = std::max(most,
                        line_styles::strokeCoverage(distancePx, widthPx(triangle, edge, plane, eye.positionM),
                                                    static_cast<float>(eye.footprintPx)));
    }
    return most;
}

}  // namespace curvewall
