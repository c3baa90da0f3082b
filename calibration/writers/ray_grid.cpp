#include "calibration/writers/ray_grid.h"

#include "calibration/errors.h"
#include "calibration/parallel.h"
#include "calibration/pieces/pixel_rays.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvewall {
namespace {

// The rays of about so many nodes in each direction tell a cone's axis; all of them tell its angle.
constexpr int kAxisNodes = 64;

struct Coarse {
    glm::ivec2 nodes{0};
    std::vector<glm::dvec3> directions;  // of length one, NaN in holes

    glm::dvec3 at(int x, int y) const {
        return directions[static_cast<size_t>(y) * static_cast<size_t>(nodes.x) + static_cast<size_t>(x)];
    }
};

Coarse coarseOf(const RayGrid& grid) {
    Coarse coarse{glm::min(grid.nodes, glm::ivec2(kAxisNodes)), {}};
    for (int y = 0; y < coarse.nodes.y; ++y)
        for (int x = 0; x < coarse.nodes.x; ++x) {
            const glm::ivec2 node = glm::ivec2(x, y) * (grid.nodes - 1) / glm::max(coarse.nodes - 1, 1);
            coarse.directions.push_back(
                glm::normalize(grid.rays[static_cast<size_t>(node.y) * static_cast<size_t>(grid.nodes.x) +
                                         static_cast<size_t>(node.x)]));
        }
    return coarse;
}

// The middle of the smallest ball around the directions (Badoiu and Clarkson, Smaller core-sets for balls,
// 2003). It is on the axis of the narrowest cone, if that is narrower than a half turn.
glm::dvec3 middleOf(const std::vector<glm::dvec3>& directions) {
    constexpr int kSteps = 500;
    glm::dvec3 middle = directions.front();
    for (int step = 1; step <= kSteps; ++step) {
        glm::dvec3 farthest = middle;
        double most = -1;
        for (const glm::dvec3& direction : directions) {
            const glm::dvec3 off = direction - middle;
            if (glm::dot(off, off) > most) most = glm::dot(off, off), farthest = direction;
        }
        middle += (farthest - middle) / (step + 1.0);
    }
    return middle;
}

double halfAngleRad(const std::vector<glm::dvec3>& rays, glm::dvec3 axis) {
    double widest = 0;
    for (const glm::dvec3& ray : rays)
        if (PixelRays::isRay(ray))
            widest = std::max(widest, std::atan2(glm::length(glm::cross(axis, ray)), glm::dot(axis, ray)));
    return widest;
}

// Rays all around have no middle: then an axis of the wall may be the best one.
glm::dvec3 axisOf(const std::vector<glm::dvec3>& directions) {
    glm::dvec3 mean(0);
    for (const glm::dvec3& direction : directions) mean += direction;
    glm::dvec3 best(0, 0, -1);
    double narrowest = std::numeric_limits<double>::infinity();
    for (const glm::dvec3 candidate : {middleOf(directions), mean / static_cast<double>(directions.size()),
                                       glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0),
                                       glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0)}) {
        constexpr double kNoMiddle = 1e-3, kClearlyNarrower = 1e-4;
        if (glm::length(candidate) < kNoMiddle) continue;
        const double angle = halfAngleRad(directions, glm::normalize(candidate));
        if (angle >= narrowest - kClearlyNarrower) continue;
        narrowest = angle;
        best = glm::normalize(candidate);
    }
    return best;
}

glm::dvec3 columnDirection(const Coarse& coarse) {
    glm::dvec3 sum(0);
    for (int y = 0; y < coarse.nodes.y; ++y)
        for (int x = 0; x + 1 < coarse.nodes.x; ++x) {
            const glm::dvec3 step = coarse.at(x + 1, y) - coarse.at(x, y);
            if (!std::isnan(step.x)) sum += step;
        }
    return sum;
}

glm::dvec3 across(glm::dvec3 axis, glm::dvec3 vector) { return vector - glm::dot(vector, axis) * axis; }

Orientation orientationAlong(glm::dvec3 axis, glm::dvec3 columns) {
    constexpr double kAlongAxis = 1e-6;
    glm::dvec3 right = across(axis, columns);
    if (glm::length(right) < kAlongAxis)
        right = across(axis, std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 0, 1));
    right = glm::normalize(right);
    return orientationFromRotation(glm::dmat3(right, glm::cross(right, axis), -axis));
}

}  // namespace

glm::dvec2 RayGrid::positionPx(glm::ivec2 node, glm::ivec2 sizePx) const {
    return alignment == Alignment::centers ? glm::dvec2(sizePx) * (glm::dvec2(node) + 0.5) / glm::dvec2(nodes)
                                           : glm::dvec2(sizePx) * glm::dvec2(node) / glm::dvec2(nodes - 1);
}

RayGrid rayGrid(const Display& display, std::optional<glm::ivec2> nodes) {
    RayGrid grid{nodes.value_or(display.sizePx), nodes ? Alignment::corners : Alignment::centers, {}};
    if (std::min(grid.nodes.x, grid.nodes.y) < 2)
        throw UsageError(fmt::format("display \"{}\": a grid needs 2 x 2 nodes, and it has {} x {} pixels",
                                     display.name, grid.nodes.x, grid.nodes.y));
    grid.rays.assign(static_cast<size_t>(grid.nodes.x) * static_cast<size_t>(grid.nodes.y),
                     glm::dvec3(std::numeric_limits<double>::quiet_NaN()));
    parallelRanges(grid.nodes.y, [&](int begin, int end) {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < grid.nodes.x; ++x) {
                const auto ray = display.projection->unproject(grid.positionPx({x, y}, display.sizePx));
                if (ray && std::isfinite(glm::dot(*ray, *ray)))
                    grid.rays[static_cast<size_t>(y) * static_cast<size_t>(grid.nodes.x) +
                              static_cast<size_t>(x)] = *ray;
            }
    });
    if (std::ranges::none_of(grid.rays, &PixelRays::isRay))
        throw UsageError(fmt::format("display \"{}\" shows nothing at any node of a grid of {} x {}",
                                     display.name, grid.nodes.x, grid.nodes.y));
    return grid;
}

ViewCone viewCone(const RayGrid& grid) {
    const Coarse coarse = coarseOf(grid);
    std::vector<glm::dvec3> directions;
    std::ranges::copy_if(coarse.directions, std::back_inserter(directions), &PixelRays::isRay);
    if (directions.empty())
        for (const glm::dvec3& ray : grid.rays)
            if (PixelRays::isRay(ray)) directions.push_back(glm::normalize(ray));
    const glm::dvec3 axis = axisOf(directions);
    return {orientationAlong(axis, columnDirection(coarse)), halfAngleRad(grid.rays, axis)};
}

bool fitsFrustum(const ViewCone& cone) {
    constexpr double kWidestDeg = 85;
    return cone.halfAngleRad < glm::radians(kWidestDeg);
}

Frustum frustumAround(const RayGrid& grid, const ViewCone& cone) {
    constexpr double kMargin = 1e-6;  // so that nothing falls on a border, and a single ray has an area
    const glm::dmat3 viewFromWall = glm::transpose(rotationFromOrientation(cone.orientation));
    glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const glm::dvec3& ray : grid.rays) {
        if (!PixelRays::isRay(ray)) continue;
        const glm::dvec3 seen = viewFromWall * ray;
        low = glm::min(low, glm::dvec2(seen) / -seen.z);
        high = glm::max(high, glm::dvec2(seen) / -seen.z);
    }
    low -= kMargin * (1.0 + high - low);
    high += kMargin * (1.0 + high - low);
    return {std::atan(low.x), std::atan(high.x), std::atan(low.y), std::atan(high.y), cone.orientation};
}

}  // namespace curvewall
