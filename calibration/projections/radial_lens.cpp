#include "calibration/projections/radial_lens.h"

#include "calibration/projections/polynomial.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace curvewall {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-12;  // what borders are given, so that pixels on them come back

double polynomialLimitRad(const RadialFunction& function) {
    Polynomial p{0};
    p.insert(p.end(), function.coefficients.begin(), function.coefficients.end());
    const Polynomial slope = derivativeOf(p);
    const auto first = std::ranges::find_if(slope, [](double coefficient) { return coefficient != 0; });
    if (first == slope.end() || *first < 0) return 0;
    const std::vector<double> turns = rootsWithin(slope, 0, kPi);
    return turns.empty() ? kPi : turns.front();
}

}  // namespace

double RadialFunction::radius(double angleRad) const {
    return maths::radialRadius(static_cast<int>(model), coefficients.data(), angleRad);
}

double RadialFunction::limitRad() const {
    switch (model) {
        case RadialModel::orthographic:
            return kPi / 2;
        case RadialModel::stereographic:
            return kPi - 1e-9;  // what is straight behind lies at infinity
        case RadialModel::polynomial:
            return polynomialLimitRad(*this);
        case RadialModel::equisolid:
        case RadialModel::equidistant:
            break;
    }
    return kPi;
}

RadialLens::RadialLens(const RadialFunction& function, glm::dvec2 centrePx, glm::dvec2 focalPx,
                       double edgeRad)
    : function_(function),
      centrePx_(centrePx),
      focalPx_(focalPx),
      edgeRad_(edgeRad),
      edgeRadius_(function.radius(edgeRad)),
      limitRad_(function.limitRad()) {}

std::optional<glm::dvec3> RadialLens::direction(glm::dvec2 px) const {
    const glm::dvec2 offset = (px - centrePx_) / focalPx_;
    if (!(glm::length(offset) <= edgeRadius_ * (1 + kRounding))) return std::nullopt;
    return maths::radialDirection(static_cast<int>(function_.model), function_.coefficients.data(),
                                  {offset.x, -offset.y}, edgeRad_);
}

std::vector<glm::dvec2> RadialLens::positions(glm::dvec3 direction) const {
    const double angleRad = std::atan2(std::hypot(direction.x, direction.y), -direction.z);
    if (!(angleRad <= limitRad_ + kRounding)) return {};
    const glm::dvec2 offset =
        maths::radialPosition(static_cast<int>(function_.model), function_.coefficients.data(), direction);
    return {centrePx_ + focalPx_ * glm::dvec2(offset.x, -offset.y)};
}

LensPtr circularLens(const RadialFunction& function, double fovRad, glm::ivec2 sizePx) {
    const double circlePx = 0.5 * std::min(sizePx.x, sizePx.y);
    return std::make_shared<RadialLens>(function, 0.5 * glm::dvec2(sizePx),
                                        glm::dvec2(circlePx / function.radius(0.5 * fovRad)), 0.5 * fovRad);
}

LensPtr curvilinearLens(double fovRad, glm::ivec2 sizePx) {
    const RadialFunction function{RadialModel::stereographic};
    return std::make_shared<RadialLens>(function, 0.5 * glm::dvec2(sizePx),
                                        glm::dvec2(0.5 * sizePx.x / std::tan(0.5 * fovRad)),
                                        function.limitRad());
}

}  // namespace curvewall
