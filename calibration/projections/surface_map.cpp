#include "calibration/projections/surface_map.h"

#include "calibration/projections/grid_map.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace curvewall {
namespace {

constexpr double kNoPoint = 1e-5;  // programs that write such maps mark what they did not measure by zeros
constexpr double kFarthest = 1e12;

// What an intersection in double precision rounds by, as a share of the largest coordinate.
constexpr double kRounding = 1e-12;

glm::dvec3 blend(const MeasuredSurface::Corners& c, glm::dvec2 st) {
    return glm::mix(glm::mix(c.v00, c.v10, st.x), glm::mix(c.v01, c.v11, st.x), st.y);
}

// A ray from the origin with two directions across it: what it meets is where both are zero.
class RayLine {
public:
    explicit RayLine(glm::dvec3 ray) : along_(glm::normalize(ray)) {
        const glm::dvec3 size = glm::abs(along_);
        glm::dvec3 axis(0);  // the one that the ray is least along
        axis[size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2] = 1;
        across1_ = glm::normalize(glm::cross(along_, axis));
        across2_ = glm::cross(along_, across1_);
        // Not infinite: that times zero would be no number.
        constexpr double kLeast = 1e-200;
        for (int i = 0; i < 3; ++i)
            perUnit_[i] = 1 / (std::abs(along_[i]) < kLeast ? std::copysign(kLeast, along_[i]) : along_[i]);
    }

    glm::dvec2 across(glm::dvec3 point) const {
        return {glm::dot(across1_, point), glm::dot(across2_, point)};
    }
    double along(glm::dvec3 point) const { return glm::dot(along_, point); }

    // The boxes that the ray meets, coming from an eye.
    TileMask boxesMet(const BoxTile<3>& tile, glm::dvec3 eye) const {
        TileMask mask = 0;
        for (size_t i = 0; i < BoxTile<3>::kBoxes; ++i) {
            double enter = 0, leave = std::numeric_limits<double>::infinity();
            for (size_t axis = 0; axis < 3; ++axis) {
                const auto k = static_cast<int>(axis);
                const double a = (static_cast<double>(tile.low[axis][i]) - eye[k]) * perUnit_[k];
                const double b = (static_cast<double>(tile.high[axis][i]) - eye[k]) * perUnit_[k];
                enter = std::max(enter, std::min(a, b));
                leave = std::min(leave, std::max(a, b));
            }
            const bool meets = (enter <= leave) & (tile.low[0][i] <= tile.high[0][i]);
            mask |= static_cast<TileMask>(meets) << i;
        }
        return mask;
    }

private:
    glm::dvec3 along_, across1_{}, across2_{}, perUnit_{};
};

}  // namespace

MeasuredSurface::MeasuredSurface(NumberMap points, bool bottomRowFirst, glm::ivec2 sizePx,
                                 Alignment alignment)
    : points_(std::move(points)),
      bottomRowFirst_(bottomRowFirst),
      layout_(points_.sizePx, sizePx, alignment),
      pyramid_(survey()) {}

glm::dvec3 MeasuredSurface::sample(glm::ivec2 line) const {
    const glm::ivec2 at = layout_.nodeAt(line);
    const float* number = points_.at(at.x, bottomRowFirst_ ? points_.sizePx.y - 1 - at.y : at.y);
    const glm::dvec3 point(number[0], number[1], number[2]);
    const bool isNumber =
        std::abs(point.x) <= kFarthest && std::abs(point.y) <= kFarthest && std::abs(point.z) <= kFarthest;
    if (isNumber && largestCoordinate(point) >= kNoPoint) return point;
    return glm::dvec3(std::numeric_limits<double>::quiet_NaN());
}

glm::dvec3 MeasuredSurface::node(glm::ivec2 line) const {
    if (!layout_.hasBorder()) return sample(line);
    return layout_.straightAt<glm::dvec3>(line, [this](glm::ivec2 l) { return sample(l); });
}

std::optional<MeasuredSurface::Corners> MeasuredSurface::corners(glm::ivec2 cell) const {
    const Corners c{node(cell), node(cell + glm::ivec2(1, 0)), node(cell + glm::ivec2(0, 1)), node(cell + 1)};
    if (isHoleCell(c.v00, c.v10, c.v01, c.v11)) return std::nullopt;
    return c;
}

GridPyramid<3> MeasuredSurface::survey() {
    const auto visitNode = [&](glm::dvec3 point) {
        if (std::isnan(point.x)) return;
        hasSamples_ = true;
        extent_ = std::max(extent_, largestCoordinate(point));
    };
    const auto visitCell = [&](glm::dvec3 v00, glm::dvec3 v10, glm::dvec3 v01, glm::dvec3 v11) {
        hasArea_ = hasArea_ || !isHoleCell(v00, v10, v01, v11);
    };
    return {layout_.cells(), 0, [this](glm::ivec2 line) { return node(line); }, visitNode, visitCell};
}

SurfaceMap::SurfaceMap(std::shared_ptr<const MeasuredSurface> surface, double unitM, const Pose& pose,
                       glm::dvec3 eyeM)
    : surface_(std::move(surface)),
      unitM_(unitM),
      pose_(pose),
      wallFromSurface_(rotationFromOrientation(pose.orientation)),
      eye_(glm::transpose(wallFromSurface_) * (eyeM - pose.centerM) / unitM) {}

std::optional<glm::dvec3> SurfaceMap::unproject(glm::dvec2 px) const {
    for (const auto& [cell, st] : surface_->layout().cellsAt(px))
        if (const auto corners = surface_->corners(cell)) {
            const glm::dvec3 ray = blend(*corners, st) - eye_;
            if (ray == glm::dvec3(0)) return std::nullopt;  // the eye lies in this very point
            return wallFromSurface_ * ray * unitM_;
        }
    return std::nullopt;
}

std::vector<glm::dvec2> SurfaceMap::project(glm::dvec3 ray) const {
    const RayLine line(glm::transpose(wallFromSurface_) * ray);
    std::vector<glm::dvec2> positions;
    const double slack = kRounding * std::max(largestCoordinate(eye_), surface_->extent());
    surface_->pyramid().forBlocks(
        [&](const BoxTile<3>& tile) { return line.boxesMet(tile, eye_); },
        [&](const CellBlock& block) {
            solveBlock(
                block, glm::dvec2(0), slack,
                [&](glm::ivec2 node) { return line.across(surface_->node(node) - eye_); },
                [&](glm::ivec2 cell, glm::dvec2 st, const maths::BilinearCell& /*across*/) {
                    const auto corners = surface_->corners(cell);
                    if (corners && line.along(blend(*corners, st) - eye_) > 0)
                        addIfNew(positions, surface_->layout().positionPx({cell, st}));
                });
        });
    return positions;
}

ProjectionPtr SurfaceMap::seenFrom(glm::dvec3 eyeM) const {
    return std::make_shared<SurfaceMap>(surface_, unitM_, pose_, eyeM);
}

}  // namespace curvewall
