#include "calibration/pieces/faceted_height.h"

#include <Eigen/Dense>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace curvewall {
namespace {

constexpr double kLeastPart = 1e-6;  // weights stay above this part of the tolerance

// In px, positive where the plane (height at the site, slope) is above the display.
double errorOf(const HeightSample& sample, glm::dvec2 sitePx, glm::dvec3 plane) {
    const glm::dvec2 off = sample.px - sitePx;
    return (plane[0] + plane[1] * off.x + plane[2] * off.y - sample.height) * sample.pxPerHeight;
}

// The largest error is a convex function of the shift.
double shiftToEvenError(glm::dvec2 sitePx, std::span<const HeightSample> samples, glm::dvec3 plane) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    std::vector<glm::dvec2> errors;  // without a shift, and what a unit of shift adds
    for (const HeightSample& sample : samples) {
        const glm::dvec2 error(errorOf(sample, sitePx, plane), sample.pxPerHeight);
        errors.push_back(error);
        if (!(error.y > 0)) continue;
        low = std::min(low, -error.x / error.y);
        high = std::max(high, -error.x / error.y);
    }
    const auto largest = [&](double shift) {
        double most = 0;
        for (glm::dvec2 error : errors) most = std::max(most, std::abs(error.x + shift * error.y));
        return most;
    };
    for (int step = 0; step < 20; ++step) {
        const double a = low + 0.4 * (high - low), b = low + 0.6 * (high - low);
        if (largest(a) < largest(b))
            high = b;
        else
            low = a;
    }
    return std::isfinite(low + high) ? 0.5 * (low + high) : 0;
}

// The plane whose largest error over the samples is smallest: least squares, made uneven by Lawson's
// weights, and then the height half way between the two ends of the error.
void fitToCell(RadialFacet& facet, const FacetCell& cell, double tolerancePx, int lawsonSteps) {
    std::vector<double> weights;
    for (const HeightSample& sample : cell.samples)
        weights.push_back(std::max(sample.pxPerHeight * sample.pxPerHeight, 1e-12));
    glm::dvec3 best(0);
    for (int step = 0; step <= lawsonSteps; ++step) {
        Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
        Eigen::Vector3d right = Eigen::Vector3d::Zero();
        for (size_t i = 0; i < weights.size(); ++i) {
            const glm::dvec2 off = cell.samples[i].px - facet.sitePx;
            const Eigen::Vector3d row(1, off.x, off.y);
            normal += weights[i] * row * row.transpose();
            right += weights[i] * cell.samples[i].height * row;
        }
        const Eigen::LLT<Eigen::Matrix3d> factors(normal);
        if (factors.info() != Eigen::Success) return;
        const Eigen::Vector3d plane = factors.solve(right);
        if (!plane.allFinite()) return;
        best = {plane[0], plane[1], plane[2]};
        double sum = 0;
        for (size_t i = 0; i < weights.size(); ++i) {
            const double error = errorOf(cell.samples[i], facet.sitePx, best);
            sum += weights[i] *= std::abs(error) + kLeastPart * tolerancePx;
        }
        for (double& weight : weights) weight /= sum;
    }
    best[0] += shiftToEvenError(facet.sitePx, cell.samples, best);
    const glm::dvec2 slope(best[1], best[2]);
    facet.plane = {best[0] - glm::dot(slope, facet.sitePx), slope};
    glm::dvec2 middle(0);
    for (const HeightSample& sample : cell.samples) middle += sample.px / double(cell.samples.size());
    facet.sitePx = middle;
}

}  // namespace

FacetedHeight::FacetedHeight(const RadialMap& map, std::vector<RadialFacet> facets)
    : map_(map), facets_(std::move(facets)) {
    rebuild(1);
}

double FacetedHeight::errorPx() const {
    return cells_.empty() ? 0 : std::ranges::max(cells_, {}, &FacetCell::errorPx).errorPx;
}

void FacetedHeight::relax(double tolerancePx, int lawsonSteps, int samplesOutward) {
    for (size_t k = 0; k < facets_.size(); ++k) fitToCell(facets_[k], cells_[k], tolerancePx, lawsonSteps);
    rebuild(samplesOutward);
}

void FacetedHeight::rebuild(int samplesOutward) {
    std::vector<HeightPlane> planes;
    for (const RadialFacet& facet : facets_) planes.push_back(facet.plane);
    envelope_ = lowestPlanes(planes, map_.sizePx());
    cells_.clear();
    std::vector<RadialFacet> used;
    for (size_t k = 0; k < facets_.size(); ++k) {
        if (envelope_.cells[k].empty()) continue;
        FacetCell cell = cellOf(facets_[k], std::move(envelope_.cells[k]), samplesOutward);
        if (cell.samples.empty()) continue;
        used.push_back(facets_[k]);
        cells_.push_back(std::move(cell));
    }
    facets_ = std::move(used);
    envelope_.cells.clear();
}

// Samples at the site, around what the cell shows, and on the way there.
FacetCell FacetedHeight::cellOf(const RadialFacet& facet, std::vector<uint32_t> corners,
                                int samplesOutward) const {
    FacetCell cell{std::move(corners), {}, 0};
    const glm::dmat3 points = map_.pointsOf(facet.plane), screenFromRay = glm::inverse(points);
    const glm::dvec3 axisOnScreen = screenFromRay * map_.axis();
    const auto addShown = [&](glm::dvec2 px) {
        const auto height = map_.height(px);
        if (!height) return;
        const glm::dvec3 landing = screenFromRay * map_.pointAt(px, *height);
        const double error = landing.z > 0 ? glm::distance(glm::dvec2(landing) / landing.z, px)
                                           : std::numeric_limits<double>::infinity();
        cell.errorPx = std::max(cell.errorPx, error);
        cell.samples.push_back({px, *height, glm::length(glm::dvec2(axisOnScreen) - px * axisOnScreen.z)});
    };
    addShown(facet.sitePx);
    for (glm::dvec2 outermost : outlineOf(facet.sitePx, cell.corners))
        for (int part = 1; part <= samplesOutward; ++part)
            addShown(glm::mix(facet.sitePx, outermost, double(part) / samplesOutward));
    return cell;
}

// Around what a cell shows: its corners, the middles between, and where the display ends.
std::vector<glm::dvec2> FacetedHeight::outlineOf(glm::dvec2 sitePx,
                                                 const std::vector<uint32_t>& corners) const {
    std::vector<glm::dvec2> outline, rim;
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 from = envelope_.corners[corners[i]];
        const glm::dvec2 to = envelope_.corners[corners[(i + 1) % corners.size()]];
        const bool fromShown = map_.height(from).has_value(), toShown = map_.height(to).has_value();
        if (fromShown) outline.push_back(from);
        if (const glm::dvec2 middle = 0.5 * (from + to); map_.height(middle)) outline.push_back(middle);
        if (fromShown != toShown)
            rim.push_back(lastShown(map_, fromShown ? from : to, fromShown ? to : from));
        if (!fromShown) rim.push_back(lastShown(map_, sitePx, from));
    }
    addBetween(sitePx, rim);
    outline.insert(outline.end(), rim.begin(), rim.end());
    return outline;
}

// Corners far outside the display leave wide angles between the places where it ends.
void FacetedHeight::addBetween(glm::dvec2 sitePx, std::vector<glm::dvec2>& rim) const {
    constexpr int kParts = 4;
    const size_t count = rim.size();
    if (count < 2) return;
    glm::dvec2 outward(0);
    for (glm::dvec2 px : rim) outward += px - sitePx;
    const auto angleOf = [&](glm::dvec2 px) {
        const glm::dvec2 off = px - sitePx;
        return std::atan2(outward.x * off.y - outward.y * off.x, glm::dot(outward, off));
    };
    std::ranges::sort(rim, {}, angleOf);
    for (size_t i = 0; i + 1 < count; ++i) {
        for (int part = 1; part < kParts; ++part) {
            const glm::dvec2 chord = glm::mix(rim[i], rim[i + 1], double(part) / kParts);
            rim.push_back(lastShown(map_, chord, chord + outward));
        }
    }
}

glm::dvec2 lastShown(const RadialMap& map, glm::dvec2 on, glm::dvec2 off) {
    for (int halving = 0; halving < 20; ++halving) {
        const glm::dvec2 middle = 0.5 * (on + off);
        (map.height(middle) ? on : off) = middle;
    }
    return on;
}

}  // namespace curvewall
