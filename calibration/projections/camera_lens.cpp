#include "calibration/projections/camera_lens.h"

#include "calibration/projections/polynomial.h"
#include "calibration/projections/radial_lens.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvewall {
namespace {

constexpr double kFarthestRadius = 1e4;    // 0.006 degrees from at right angles to the axis
constexpr double kTolerancePx = 1e-8;      // of the inverse distortion
constexpr int kTableSteps = 128;           // in each direction
constexpr glm::dvec2 kFirstCentrePx(0.5);  // OpenCV counts from the centre of the first pixel

using PinholeTerms = std::array<double, maths::kPinholeTerms>;

// The radius up to which the distortion D is one-to-one: where the symmetric part of its Jacobian is positive
// definite on a convex region, D is one-to-one there. With g = (1 + k1 r^2 + ...) / (1 + k4 r^2 + ...) the
// radial part has the eigenvalues g and d(r g)/dr, the tangential terms lower them by 6 |p| r at most and the
// thin prism by r |2 (s1, s3)| + 4 r^3 |(s2, s4)|, all of which some side of the circle attains. The first
// zero, by polynomials in r, is therefore exact for a purely radial lens and on the safe side for every
// other.
double oneToOneRadius(const PinholeTerms& k) {
    const Polynomial above{1, 0, k[0], 0, k[1], 0, k[4]}, below{1, 0, k[5], 0, k[6], 0, k[7]}, r{0, 1};
    const Polynomial lost{0, 6 * std::hypot(k[2], k[3]) + 2 * std::hypot(k[8], k[10]), 0,
                          4 * std::hypot(k[9], k[11])};
    const Polynomial across = above * below - lost * below * below;
    const Polynomial along = across + r * (derivativeOf(above) * below - above * derivativeOf(below));
    double radius = kFarthestRadius;
    for (const Polynomial& p : {below, across, along})
        for (const double root : rootsWithin(p, 0, radius)) radius = std::min(radius, root);
    return radius;
}

// A little inside, since the radius may be a pole.
double mostDistortedRadius(const PinholeTerms& k, double radius) {
    const PinholeTerms radial{k[0], k[1], 0, 0, k[4], k[5], k[6], k[7]};
    const double r2 = radius * radius;
    const double most =
        maths::pinholeDistorted(radial.data(), {radius * (1 - 1e-9), 0}).x +
        r2 * (3 * std::hypot(k[2], k[3]) + std::hypot(k[8], k[10]) + r2 * std::hypot(k[9], k[11]));
    return most * (1 + 1e-6);
}

// The sensor turned by tau about x and then y, and projected back along the axis (OpenCV's tilted model).
glm::dmat3 sensorTilt(double tauX, double tauY) {
    const double cx = std::cos(tauX), sx = std::sin(tauX), cy = std::cos(tauY), sy = std::sin(tauY);
    // GLM constructs by columns.
    const glm::dmat3 aboutX(1, 0, 0, 0, cx, -sx, 0, sx, cx), aboutY(cy, 0, sy, 0, 1, 0, -sy, 0, cy);
    const glm::dmat3 turned = aboutY * aboutX;
    return glm::dmat3(turned[2][2], 0, 0, 0, turned[2][2], 0, -turned[2][0], -turned[2][1], 1) * turned;
}

std::vector<double> padded(std::vector<double> numbers, size_t count) {
    numbers.resize(count, 0.0);
    return numbers;
}

}  // namespace

PinholeLens::PinholeLens(const CameraIntrinsics& intrinsics) : intrinsics_(intrinsics) {
    const std::vector<double> distortion = padded(intrinsics.distortion, maths::kPinholeTerms + 2);
    std::copy_n(distortion.begin(), terms_.size(), terms_.begin());
    tilt_ = sensorTilt(distortion[maths::kPinholeTerms], distortion[maths::kPinholeTerms + 1]);
    untilt_ = glm::inverse(tilt_);
    mostRadius_ = oneToOneRadius(terms_);
    mostDistortedRadius_ = mostDistortedRadius(terms_, mostRadius_);
    tableExtent_ = (glm::abs(intrinsics.principalPx) + 1.0) / glm::abs(intrinsics.focalPx);
    fillTable();
}

// From the middle outwards, each point from its neighbour's answer, and none from a neighbour without one:
// the search for what is not there takes longest.
void PinholeLens::fillTable() {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    constexpr int kMiddle = kTableSteps / 2;
    std::vector<int> outwards{kMiddle};
    for (int away = 1; away <= kMiddle; ++away)
        outwards.insert(outwards.end(), {kMiddle - away, kMiddle + away});
    const auto inwards = [](int i) { return i < kMiddle ? i + 1 : i - 1; };
    const auto entry = [this](int x, int y) -> glm::dvec2& {
        return table_[static_cast<size_t>(y) * (kTableSteps + 1) + static_cast<size_t>(x)];
    };
    table_.assign(size_t{kTableSteps + 1} * (kTableSteps + 1), glm::dvec2(kNone));
    for (const int y : outwards)
        for (const int x : outwards) {
            const glm::dvec2 start = y != kMiddle   ? entry(x, inwards(y))
                                     : x != kMiddle ? entry(inwards(x), y)
                                                    : glm::dvec2(0);
            const glm::dvec2 distorted = (2.0 / kTableSteps * glm::dvec2(x, y) - 1.0) * tableExtent_;
            if (std::isnan(start.x) || !isWithinReach(distorted)) continue;
            const glm::dvec3 found =
                maths::pinholeUndistortedFrom(terms_.data(), distorted, start, mostRadius_, tolerance());
            if (found.z > 0) entry(x, y) = glm::dvec2(found);
        }
}

double PinholeLens::tolerance() const {
    return kTolerancePx / std::max(intrinsics_.focalPx.x, intrinsics_.focalPx.y);
}

bool PinholeLens::isWithinReach(glm::dvec2 distorted) const {
    return glm::dot(distorted, distorted) <= mostDistortedRadius_ * mostDistortedRadius_;
}

// NaN beyond the table.
glm::dvec2 PinholeLens::startFor(glm::dvec2 distorted) const {
    const glm::dvec2 at = (distorted / tableExtent_ + 1.0) * (0.5 * kTableSteps);
    if (!(at.x >= 0 && at.y >= 0 && at.x < kTableSteps && at.y < kTableSteps))
        return glm::dvec2(std::numeric_limits<double>::quiet_NaN());
    const int x = static_cast<int>(at.x), y = static_cast<int>(at.y);
    const glm::dvec2* above = &table_[static_cast<size_t>(y) * (kTableSteps + 1) + static_cast<size_t>(x)];
    const glm::dvec2* below = above + kTableSteps + 1;
    const double u = at.x - x, v = at.y - y;
    const glm::dvec2 top = above[0] + u * (above[1] - above[0]),
                     bottom = below[0] + u * (below[1] - below[0]);
    return top + v * (bottom - top);
}

std::optional<glm::dvec3> PinholeLens::direction(glm::dvec2 px) const {
    const glm::dvec2 sensor = (px - kFirstCentrePx - intrinsics_.principalPx) / intrinsics_.focalPx;
    const glm::dvec3 untilted = maths::pinholeTilted(untilt_, sensor);
    const glm::dvec2 distorted(untilted);
    if (!(untilted.z > 0 && isWithinReach(distorted))) return std::nullopt;
    const glm::dvec2 start = startFor(distorted);
    const glm::dvec3 found =
        std::isnan(start.x + start.y)
            ? maths::pinholeUndistorted(terms_.data(), distorted, mostRadius_, tolerance())
            : maths::pinholeUndistortedFrom(terms_.data(), distorted, start, mostRadius_, tolerance());
    if (!(found.z > 0)) return std::nullopt;
    return glm::normalize(glm::dvec3(found.x, -found.y, -1));
}

std::vector<glm::dvec2> PinholeLens::positions(glm::dvec3 direction) const {
    if (!(direction.z < 0)) return {};
    const glm::dvec2 p = glm::dvec2(direction.x, -direction.y) / -direction.z;
    if (!(glm::length(p) < mostRadius_ * (1 + 1e-12))) return {};
    const glm::dvec3 sensor = maths::pinholeTilted(tilt_, maths::pinholeDistorted(terms_.data(), p));
    if (!(sensor.z > 0)) return {};
    return {glm::dvec2(sensor) * intrinsics_.focalPx + intrinsics_.principalPx + kFirstCentrePx};
}

LensPtr fisheyeCameraLens(const CameraIntrinsics& intrinsics) {
    const std::vector<double> k = padded(intrinsics.distortion, 4);
    const RadialFunction function{RadialModel::polynomial, {1, 0, k[0], 0, k[1], 0, k[2], 0, k[3]}};
    return std::make_shared<RadialLens>(function, intrinsics.principalPx + kFirstCentrePx, intrinsics.focalPx,
                                        function.limitRad());
}

}  // namespace curvewall
