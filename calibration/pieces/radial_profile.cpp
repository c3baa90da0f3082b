#include "calibration/pieces/radial_profile.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace curvewall {
namespace {

constexpr int kSteps = 1024;
constexpr int kDirections = 64;
// Rows of a covering with hexagons whose corners are one away are 1.5 apart, and their centres sqrt(3). These
// were measured to leave the smallest error at the rim.
constexpr double kRowSpacing = 1.47, kBeyondLastRow = 0.6;

bool isOn(glm::dvec2 px, glm::ivec2 sizePx) {
    return px.x >= 0 && px.y >= 0 && px.x <= sizePx.x && px.y <= sizePx.y;
}

}  // namespace

double pxPerHeight(const RadialMap& map, const HeightPlane& plane, glm::dvec2 px) {
    const glm::dmat3 points = map.pointsOf(plane);
    const glm::dvec3 moved =
        glm::inverse(points) * (map.pointAt(px, plane.at(px) + 1) - points * glm::dvec3(px, 1));
    return glm::length(glm::dvec2(moved) - px * moved.z);
}

std::optional<RadialProfile> RadialProfile::of(const RadialMap& map, double mostAsidePx) {
    RadialProfile profile(map);
    double rim = 0;
    for (int i = 0; i < kDirections; ++i) {
        const double angle = 2 * std::numbers::pi * i / kDirections;
        const glm::dvec2 direction(std::cos(angle), std::sin(angle));
        if (const double far = profile.reach(direction); far > rim) {
            rim = far;
            profile.direction_ = direction;
        }
    }
    if (!(rim > 0)) return std::nullopt;
    for (int i = 1; i < kSteps; ++i) {
        // Closer towards the rim, where some lenses bend without bound.
        const double left = 1 - double(i) / kSteps;
        const auto step = profile.stepAt(rim * (1 - left * left), rim);
        if (!step) continue;
        if (!(step->bend >= 0 && step->bendAround >= 0)) return std::nullopt;
        profile.steps_.push_back(*step);
    }
    if (profile.steps_.size() < kSteps / 2 || !profile.isRound(mostAsidePx)) return std::nullopt;
    return profile;
}

// The farthest place of the display in a direction, or 0.
double RadialProfile::reach(glm::dvec2 direction) const {
    const glm::dvec2 size(map_.sizePx());
    const double farPx = glm::length(size) + glm::distance(map_.centrePx(), 0.5 * size);
    const double far =
        farPx * glm::length(map_.flatFromPx() * glm::normalize(map_.pxAt(direction) - map_.centrePx()));
    const auto shows = [&](double radius) {
        const glm::dvec2 px = map_.pxAt(radius * direction);
        return isOn(px, map_.sizePx()) && map_.height(px);
    };
    int last = kDirections;
    while (last > 0 && !shows(far * last / kDirections)) --last;
    double inside = far * last / kDirections, outside = far * (last + 1) / kDirections;
    if (last == 0 && !shows(0)) return 0;
    for (int halving = 0; halving < 40; ++halving) {
        const double middle = 0.5 * (inside + outside);
        (shows(middle) ? inside : outside) = middle;
    }
    return inside;
}

// Derivatives by differences of about half a pixel, closer at the rim.
std::optional<RadialProfile::Step> RadialProfile::stepAt(double radius, double rim) const {
    const double onePx = glm::length(map_.flatFromPx()[0]);
    const double e = std::min(0.5 * onePx, 0.25 * std::min(rim - radius, radius));
    const auto before = heightAt(radius - e), at = heightAt(radius), after = heightAt(radius + e);
    if (!before || !at || !after) return std::nullopt;
    Step step{radius, (*after - *before) / (2 * e)};
    const glm::dvec2 px = map_.pxAt(radius * direction_);
    const glm::dvec2 slopePx = glm::transpose(map_.flatFromPx()) * (step.slope * direction_);
    const double weight = pxPerHeight(map_, {*at - glm::dot(slopePx, px), slopePx}, px);
    constexpr double kRounding = 1e-9;  // of what is next to flat
    const double bend = -(*after - 2 * *at + *before) / (e * e), bendAround = -step.slope / radius;
    const double least = -kRounding * std::abs(*at) / (onePx * onePx);
    step.bend = bend >= least ? std::max(0.0, bend) * weight : bend;
    step.bendAround = bendAround >= least ? std::max(0.0, bendAround) * weight : bendAround;
    return step;
}

// Whether places at one radius have one height, in all directions.
bool RadialProfile::isRound(double mostAsidePx) const {
    const size_t every = std::max<size_t>(1, steps_.size() / 16);
    for (size_t i = every / 2; i < steps_.size(); i += every) {
        const Step& step = steps_[i];
        const glm::dvec2 px = map_.pxAt(step.radius * direction_);
        const double height = *map_.height(px);
        const glm::dvec2 slopePx = glm::transpose(map_.flatFromPx()) * (step.slope * direction_);
        const double weight = pxPerHeight(map_, {height - glm::dot(slopePx, px), slopePx}, px);
        for (int k = 0; k < kDirections; ++k) {
            const double angle = 2 * std::numbers::pi * k / kDirections;
            const glm::dvec2 other = map_.pxAt(step.radius * glm::dvec2(std::cos(angle), std::sin(angle)));
            if (!isOn(other, map_.sizePx())) continue;
            const auto seen = map_.height(other);
            if (seen && !(std::abs(*seen - height) * weight <= mostAsidePx)) return false;
        }
    }
    return true;
}

double RadialProfile::facetCount(double tolerancePx) const {
    const double hexagon = 1.5 * std::numbers::sqrt3 * 4 * tolerancePx;  // its area in the metric of the bend
    double count = 0, before = 0;
    for (const Step& step : steps_) {
        const double area = 2 * std::numbers::pi * step.radius * (step.radius - before);
        count += area * std::sqrt(step.bend * step.bendAround) / hexagon;
        before = step.radius;
    }
    return count;
}

// From the centre to each step, and 0 before: lengths in the metric of the bend, in which facets may reach
// one to each side.
std::vector<double> RadialProfile::bendLengths(double tolerancePx) const {
    std::vector<double> lengths{0};
    double before = 0;
    for (const Step& step : steps_) {
        lengths.push_back(lengths.back() + (step.radius - before) * std::sqrt(step.bend / (4 * tolerancePx)));
        before = step.radius;
    }
    return lengths;
}

double RadialProfile::rowsFor(double tolerancePx) const {
    return bendLengths(tolerancePx).back() / kRowSpacing - kBeyondLastRow;
}

std::vector<RadialFacet> RadialProfile::rings(double tolerancePx, int rows, double density) const {
    const std::vector<double> lengths = bendLengths(tolerancePx);
    std::vector<RadialFacet> facets;
    const auto add = [&](double radius, double slope, double angle) {
        const glm::dvec2 outward(std::cos(angle), std::sin(angle)), px = map_.pxAt(radius * outward);
        const glm::dvec2 slopePx = glm::transpose(map_.flatFromPx()) * (slope * outward);
        facets.push_back({px, {*heightAt(radius) - glm::dot(slopePx, px), slopePx}});
    };
    add(0, 0, 0);
    double turn = 0;
    for (int row = 1; row <= rows; ++row) {
        const double length = lengths.back() * row / (rows + kBeyondLastRow);
        const auto found = std::ranges::lower_bound(lengths, length) - lengths.begin();
        const Step& step =
            steps_[static_cast<size_t>(std::clamp<std::ptrdiff_t>(found, 1, std::ssize(steps_))) - 1];
        const double around =
            2 * std::numbers::pi * step.radius * std::sqrt(density * step.bendAround / (4 * tolerancePx));
        const int count = std::max(3, static_cast<int>(std::round(around / std::numbers::sqrt3)));
        turn += std::numbers::pi / count;
        for (int i = 0; i < count; ++i) add(step.radius, step.slope, turn + 2 * std::numbers::pi * i / count);
    }
    return facets;
}

}  // namespace curvewall
