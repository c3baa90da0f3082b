#include "calibration/pieces/radial_map.h"

#include <Eigen/Dense>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace curvewall {
namespace {

constexpr int kLattice = 25;

struct Seen {
    glm::dvec2 px;
    glm::dvec3 ray;  // length one
};

std::vector<Seen> latticeOf(const Projection& projection, glm::ivec2 sizePx) {
    std::vector<Seen> lattice;
    for (int j = 0; j < kLattice; ++j) {
        for (int i = 0; i < kLattice; ++i) {
            const glm::dvec2 px = (glm::dvec2(i, j) + 0.5) / double(kLattice) * glm::dvec2(sizePx);
            if (const auto ray = projection.unproject(px)) lattice.push_back({px, glm::normalize(*ray)});
        }
    }
    return lattice;
}

// F with r . F (s, 1) = 0 for all rays, by linear least squares: the eight point method of two views, here of
// the display and of the flat screen that it is compared with. Places are scaled to about one for it.
Eigen::Matrix3d radialConstraint(const std::vector<Seen>& lattice, const Eigen::Matrix3d& fromPx) {
    Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
    for (const Seen& seen : lattice) {
        const Eigen::Vector3d s = fromPx * Eigen::Vector3d(seen.px.x, seen.px.y, 1);
        Eigen::Matrix<double, 9, 1> row;
        for (int i = 0; i < 3; ++i) row.segment<3>(3 * i) = seen.ray[i] * s;
        normal += row * row.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(normal);
    const Eigen::Matrix<double, 9, 1> f = solver.eigenvectors().col(0);
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(f.data());
}

glm::dmat3 toGlm(const Eigen::Matrix3d& m) {
    glm::dmat3 result;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) result[column][row] = m(row, column);
    return result;
}

// Whether a place lies beside the line of places that its ray allows, at this distance at most. The ray of
// the centre allows all lines through it.
bool isBeside(const Seen& seen, const Eigen::Matrix3d& f, double mostPx) {
    const Eigen::Vector3d line = f.transpose() * Eigen::Vector3d(seen.ray.x, seen.ray.y, seen.ray.z);
    const double off = std::abs(line.dot(Eigen::Vector3d(seen.px.x, seen.px.y, 1)));
    const double rounding = 1e-14 * f.norm() * glm::length(glm::dvec3(seen.px, 1));
    return off <= mostPx * line.head<2>().norm() + rounding;
}

}  // namespace

std::optional<RadialMap> RadialMap::of(const Projection& projection, glm::ivec2 sizePx, double mostAsidePx) {
    const std::vector<Seen> lattice = latticeOf(projection, sizePx);
    if (lattice.size() < 16) return std::nullopt;
    const double scale = 2.0 / std::max(sizePx.x, sizePx.y);
    Eigen::Matrix3d fromPx = Eigen::Matrix3d::Identity();
    fromPx.topRows<2>() *= scale;
    fromPx(0, 2) = -0.5 * scale * sizePx.x;
    fromPx(1, 2) = -0.5 * scale * sizePx.y;

    // The nearest matrix of rank two.
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(radialConstraint(lattice, fromPx),
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d values = svd.singularValues();
    values[2] = 0;
    const Eigen::Matrix3d f = svd.matrixU() * values.asDiagonal() * svd.matrixV().transpose() * fromPx;
    if (!std::ranges::all_of(lattice, [&](const Seen& seen) { return isBeside(seen, f, mostAsidePx); }))
        return std::nullopt;

    // F = [c]x P with P square to c, and c F = 0.
    const Eigen::Vector3d c = svd.matrixU().col(2);
    Eigen::Matrix3d cross;
    cross << 0, -c[2], c[1], c[2], 0, -c[0], -c[1], c[0], 0;
    RadialMap map(projection, sizePx);
    map.base_ = toGlm(-cross * f);
    map.axis_ = {c[0], c[1], c[2]};
    const Eigen::Vector3d centre = fromPx.inverse() * svd.matrixV().col(2);
    map.centrePx_ = {centre[0] / centre[2], centre[1] / centre[2]};

    // Two directions square to the axis span the flat screen.
    const glm::dvec3 right = glm::normalize(map.base_[0]), down = glm::cross(map.axis_, right);
    map.flatFromPx_ = glm::dmat2(glm::dot(right, map.base_[0]), glm::dot(down, map.base_[0]),
                                 glm::dot(right, map.base_[1]), glm::dot(down, map.base_[1]));
    if (!(std::abs(glm::determinant(map.flatFromPx_)) > 0) || !std::isfinite(glm::length(map.centrePx_)))
        return std::nullopt;

    const auto side = [&](const Seen& seen) { return glm::dot(seen.ray, map.pointAt(seen.px, 0)); };
    const auto first =
        std::ranges::max_element(lattice, {}, [&](const Seen& seen) { return std::abs(side(seen)); });
    if (side(*first) < 0) {
        map.base_ = -map.base_;
        map.flatFromPx_ = -map.flatFromPx_;
    }
    constexpr double kRounding = 1e-9;
    const double most = std::abs(side(*first));
    for (const Seen& seen : lattice)
        if (side(seen) < -kRounding * most) return std::nullopt;
    return map;
}

glm::dmat3 RadialMap::pointsOf(const HeightPlane& plane) const {
    return base_ + glm::outerProduct(axis_, glm::dvec3(plane.slope, plane.atOrigin));
}

RadialMap RadialMap::turnedOver() const {
    RadialMap turned = *this;
    turned.axis_ = -axis_;
    return turned;
}

std::optional<double> RadialMap::height(glm::dvec2 px) const {
    constexpr double kNearPx = 0.25;  // where rays hardly leave the axis and say nothing
    if (glm::distance(px, centrePx_) < kNearPx) {
        const auto before = height(centrePx_ - glm::dvec2(kNearPx)),
                   after = height(centrePx_ + glm::dvec2(kNearPx));
        return before && after ? std::optional(0.5 * (*before + *after)) : std::nullopt;
    }
    const auto ray = projection_->unproject(px);
    if (!ray) return std::nullopt;
    const glm::dvec3 flat = pointAt(px, 0);
    const double along = glm::dot(*ray, axis_);
    return along * glm::dot(flat, flat) / glm::dot(*ray, flat);
}

}  // namespace curvewall
