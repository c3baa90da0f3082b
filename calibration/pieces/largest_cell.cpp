#include "calibration/pieces/largest_cell.h"

#include <Eigen/Dense>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace curvewall {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// An inscribed polygon of so many corners has 99 % of an ellipse's area.
constexpr size_t kCorners = 24;
using Corners = std::array<glm::dvec2, kCorners>;

size_t after(size_t k) { return (k + 1) % kCorners; }
size_t before(size_t k) { return (k + kCorners - 1) % kCorners; }

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

// What cross(v, w) changes by, per change of w.
glm::dvec2 turned(glm::dvec2 v) { return {-v.y, v.x}; }

glm::dvec2 middleOf(const Corners& corners) {
    glm::dvec2 middle(0);
    for (glm::dvec2 corner : corners) middle += corner / double(kCorners);
    return middle;
}

// Gauss and Legendre's rule on [0, 1], exact to the ninth power.
struct Node {
    double at, share;
};
constexpr std::array<Node, 5> kNodes{{{0.04691007703066800, 0.11846344252809454},
                                      {0.23076534494715845, 0.23931433524968324},
                                      {0.5, 0.28444444444444444},
                                      {0.76923465505284155, 0.23931433524968324},
                                      {0.95308992296933200, 0.11846344252809454}}};

// By the divergence theorem.
double weightOf(const Corners& corners, const PixelWeight& weight) {
    double sum = 0;
    for (size_t k = 0; k < kCorners; ++k) {
        const glm::dvec2 edge = corners[after(k)] - corners[k];
        double flow = 0;
        for (const Node& node : kNodes) {
            const glm::dvec2 px = corners[k] + node.at * edge;
            flow += node.share * weight.at(px) * (glm::dot(weight.direction, px) - weight.originPx);
        }
        sum -= flow / (weight.power + 1) * glm::dot(weight.direction, turned(edge));
    }
    return sum;
}

// What it changes by, per move of each corner.
Corners weightSlopes(const Corners& corners, const PixelWeight& weight) {
    Corners slopes;
    slopes.fill(glm::dvec2(0));
    for (size_t k = 0; k < kCorners; ++k) {
        const glm::dvec2 edge = corners[after(k)] - corners[k];
        for (const Node& node : kNodes) {
            const glm::dvec2 outwards = -node.share * weight.at(corners[k] + node.at * edge) * turned(edge);
            slopes[k] += (1 - node.at) * outwards;
            slopes[after(k)] += node.at * outwards;
        }
    }
    return slopes;
}

// Axes in which a cell is about as wide as high and its corners are about one away from the origin.
struct Frame {
    glm::dvec2 originPx{0};
    glm::dmat2 pxFromFrame{1};

    glm::dvec2 toFrame(glm::dvec2 px) const { return glm::inverse(pxFromFrame) * (px - originPx); }
};

Frame frameOf(const Corners& corners) {
    const glm::dvec2 middle = middleOf(corners);
    glm::dmat2 spread(0);
    for (glm::dvec2 corner : corners)
        spread += glm::outerProduct(corner - middle, corner - middle) * (2.0 / double(kCorners));
    // Its Cholesky factor.
    const double a = std::sqrt(spread[0][0]), b = spread[0][1] / a;
    return {middle, {a, b, 0, std::sqrt(spread[1][1] - b * b)}};
}

// What grows: a cell and its homography.
struct Candidate {
    Corners corners;
    glm::dmat3 screenFromRay{1};
};

// Where the error is looked at: part of the way along the edge that begins at a corner, then part of the way
// from there to the middle.
struct Place {
    size_t corner = 0;
    double along = 0;
    double inwards = 0;

    glm::dvec2 px(const Corners& corners, glm::dvec2 middle) const {
        const glm::dvec2 onEdge = (1 - along) * corners[corner] + along * corners[after(corner)];
        return (1 - inwards) * onEdge + inwards * middle;
    }
};

std::vector<Place> placesOfCells() {
    constexpr int kPerEdge = 4;
    std::vector<Place> places{{0, 0, 1}};
    for (size_t k = 0; k < kCorners; ++k) {
        for (int i = 0; i < kPerEdge; ++i) places.push_back({k, double(i) / kPerEdge, 0});
        places.push_back({k, 0, k % 2 == 0 ? 0.18 : 0.32});
        if (k % 2 == 0) places.push_back({k, 0, k % 4 == 0 ? 0.5 : 0.7});
    }
    return places;
}

// From a position to where its ray lands. Nothing in holes.
std::optional<glm::dvec2> offsetPx(const Projection& projection, const glm::dmat3& screenFromRay,
                                   glm::dvec2 px) {
    const auto ray = projection.unproject(px);
    if (!ray) return std::nullopt;
    const glm::dvec3 landing = screenFromRay * *ray;
    if (!(landing.z > 0)) return glm::dvec2(kInfinity);
    return glm::dvec2(landing) / landing.z - px;
}

// The unknowns of a step: how the corners move, in the cell's frame, and the first eight entries of the
// matrix that the homography is multiplied by there, less the identity.
constexpr Eigen::Index kMoves = 2 * kCorners, kUnknowns = kMoves + 8;
using Vector = Eigen::Matrix<double, kUnknowns, 1>;
using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

Eigen::Index unknownOf(size_t corner) { return static_cast<Eigen::Index>(2 * corner); }

// A function to second order, less what makes its second derivative indefinite.
struct Quadratic {
    Vector gradient = Vector::Zero();
    Matrix hessian = Matrix::Zero();

    // -weight log(slack), given by how much the slack changes per move of some corners.
    template <size_t N>
    void addLogarithm(double weight, double slack, const std::array<size_t, N>& corners,
                      const std::array<glm::dvec2, N>& slopes) {
        for (size_t i = 0; i < N; ++i) {
            const Eigen::Vector2d a(slopes[i].x / slack, slopes[i].y / slack);
            gradient.segment<2>(unknownOf(corners[i])) -= weight * a;
            for (size_t j = 0; j < N; ++j) {
                const Eigen::Vector2d b(slopes[j].x / slack, slopes[j].y / slack);
                hessian.block<2, 2>(unknownOf(corners[i]), unknownOf(corners[j])) +=
                    weight * a * b.transpose();
            }
        }
    }
};

constexpr double kApart = 4e-2;       // how much corners keep apart
constexpr double kLongestMove = 0.5;  // of a corner in one step, in the frame

// Grows a cell by Newton's method on a barrier function (A. V. Fiacco and G. P. McCormick, 1968): minus the
// logarithm of the weight, less `barrier` times the logarithms of what has to stay positive. The corners keep
// apart, so that the places between them are close everywhere.
class CellSearch {
public:
    CellSearch(const Projection& projection, const std::vector<HalfPlane>& outline, const PixelWeight& weight,
               glm::dvec2 px, double tolerancePx)
        : projection_(projection), outline_(outline), weight_(weight), px_(px), tolerancePx_(tolerancePx) {}

    std::optional<Candidate> first(glm::dvec2 stretch);

    // False where it hardly helps.
    bool grow(Candidate& candidate, double barrier);

private:
    std::optional<Candidate> small(double radiusPx, glm::dvec2 stretch) const;
    void useSidesNear(const Frame& frame);
    double value(const Candidate& candidate, const Frame& frame, double barrier) const;
    Quadratic quadraticAt(const Candidate& candidate, const Frame& frame, double barrier) const;
    void addShape(Quadratic& sum, const Corners& corners, const Frame& frame, double barrier) const;
    void addErrors(Quadratic& sum, const Candidate& candidate, const Frame& frame, double barrier) const;

    const Projection& projection_;
    const std::vector<HalfPlane>& outline_;
    const PixelWeight& weight_;
    std::vector<HalfPlane> nearSides_;
    glm::dvec2 px_;
    double tolerancePx_;
    double damping_ = 1e-3;
};

// An ellipse with the homography that is right at its middle to first order.
std::optional<Candidate> CellSearch::small(double radiusPx, glm::dvec2 stretch) const {
    const double step = 0.3 * radiusPx;
    const auto here = projection_.unproject(px_), right = projection_.unproject(px_ + glm::dvec2(step, 0)),
               down = projection_.unproject(px_ + glm::dvec2(0, step));
    if (!here || !right || !down) return std::nullopt;
    const glm::dvec3 ray = glm::normalize(*here);
    const glm::dmat3 rays(ray, (glm::normalize(*right) - ray) / step, (glm::normalize(*down) - ray) / step);
    Candidate candidate;
    candidate.screenFromRay = glm::dmat3({px_, 1}, {1, 0, 0}, {0, 1, 0}) * glm::inverse(rays);
    const double proportion = glm::length(stretch);
    const glm::dvec2 axis = stretch / proportion;
    for (size_t k = 0; k < kCorners; ++k) {
        const double angle = 2 * std::numbers::pi * double(k) / kCorners;
        candidate.corners[k] =
            px_ + radiusPx * (std::cos(angle) * axis + std::sin(angle) / proportion * turned(axis));
    }
    return candidate;
}

std::optional<Candidate> CellSearch::first(glm::dvec2 stretch) {
    constexpr double kLeastPx = 1e-3;
    double radiusPx = kInfinity;
    for (const HalfPlane& side : outline_) radiusPx = std::min(radiusPx, 0.5 * side.depthOf(px_));
    for (; radiusPx > kLeastPx; radiusPx *= 0.5) {
        const std::optional<Candidate> candidate = small(radiusPx, stretch);
        if (candidate && value(*candidate, frameOf(candidate->corners), 1) < kInfinity) return candidate;
    }
    return std::nullopt;
}

// A step does not reach the others.
void CellSearch::useSidesNear(const Frame& frame) {
    nearSides_.clear();
    for (const HalfPlane& side : outline_)
        if (side.depthOf(frame.originPx) < 5 * kLongestMove * glm::length(side.normal * frame.pxFromFrame))
            nearSides_.push_back(side);
}

double CellSearch::value(const Candidate& candidate, const Frame& frame, double barrier) const {
    static const std::vector<Place> places = placesOfCells();
    const Corners& corners = candidate.corners;
    double logarithms = 0, apart = 0;
    bool isPossible = true;
    const auto add = [&](double slack) {
        isPossible = isPossible && slack > 0;
        logarithms += isPossible ? std::log(slack) : 0;
    };
    for (size_t k = 0; k < kCorners; ++k) {
        const glm::dvec2 edge = corners[after(k)] - corners[k];
        add(cross(corners[k] - corners[before(k)], edge));
        add(cross(edge, px_ - corners[k]));
        for (const HalfPlane& side : nearSides_) add(side.depthOf(corners[k]));
        apart += std::log(glm::distance(frame.toFrame(corners[after(k)]), frame.toFrame(corners[k])));
    }
    const glm::dvec2 middle = middleOf(corners);
    for (size_t i = 0; isPossible && i < places.size(); ++i)
        if (const auto off = offsetPx(projection_, candidate.screenFromRay, places[i].px(corners, middle)))
            add(1 - glm::dot(*off, *off) / (tolerancePx_ * tolerancePx_));
    return isPossible ? -std::log(weightOf(corners, weight_)) - barrier * logarithms - kApart * apart
                      : kInfinity;
}

Quadratic CellSearch::quadraticAt(const Candidate& candidate, const Frame& frame, double barrier) const {
    Quadratic sum;
    addShape(sum, candidate.corners, frame, barrier);
    addErrors(sum, candidate, frame, barrier);
    return sum;
}

void CellSearch::addShape(Quadratic& sum, const Corners& corners, const Frame& frame, double barrier) const {
    Corners at;
    for (size_t k = 0; k < kCorners; ++k) at[k] = frame.toFrame(corners[k]);
    const glm::dvec2 p = frame.toFrame(px_);
    std::array<size_t, kCorners> all{};
    Corners growth = weightSlopes(corners, weight_);
    for (size_t k = 0; k < kCorners; ++k) {
        const size_t a = before(k), b = k, c = after(k);
        all[k] = k;
        growth[k] = growth[k] * frame.pxFromFrame;

        const glm::dvec2 in = at[b] - at[a], out = at[c] - at[b];
        sum.addLogarithm<3>(barrier, cross(in, out), {a, b, c}, {turned(out), -turned(out + in), turned(in)});
        const glm::dvec2 toP = p - at[b];
        sum.addLogarithm<2>(barrier, cross(out, toP), {b, c}, {turned(toP - out), -turned(toP)});
        for (const HalfPlane& side : nearSides_)
            sum.addLogarithm<1>(barrier, side.depthOf(corners[k]), {k}, {-(side.normal * frame.pxFromFrame)});

        const double squared = glm::dot(out, out);
        const Eigen::Vector2d pull = kApart / squared * Eigen::Vector2d(out.x, out.y);
        const Eigen::Matrix2d stiffness = kApart / squared * Eigen::Matrix2d::Identity();
        const Eigen::Index i = unknownOf(b), j = unknownOf(c);
        sum.gradient.segment<2>(i) += pull;
        sum.gradient.segment<2>(j) -= pull;
        sum.hessian.block<2, 2>(i, i) += stiffness;
        sum.hessian.block<2, 2>(j, j) += stiffness;
        sum.hessian.block<2, 2>(i, j) -= stiffness;
        sum.hessian.block<2, 2>(j, i) -= stiffness;
    }
    sum.addLogarithm<kCorners>(1, weightOf(corners, weight_), all, growth);
}

void CellSearch::addErrors(Quadratic& sum, const Candidate& candidate, const Frame& frame,
                           double barrier) const {
    static const std::vector<Place> places = placesOfCells();
    constexpr double kStep = 0.02;  // for the slope of the error, in the frame
    const glm::dvec2 middle = middleOf(candidate.corners);
    const glm::dmat2& axes = frame.pxFromFrame;
    for (const Place& place : places) {
        const glm::dvec2 px = place.px(candidate.corners, middle);
        const auto off = offsetPx(projection_, candidate.screenFromRay, px);
        if (!off) continue;
        // Its changes per move of the edge's two corners and per entry of the homography.
        Eigen::Matrix<double, 2, 12> slopes = Eigen::Matrix<double, 2, 12>::Zero();
        const auto set = [&](Eigen::Index column, glm::dvec2 slope) {
            slopes.col(column) << slope.x, slope.y;
        };
        const glm::dvec2 landing = frame.toFrame(px + *off);
        for (int axis = 0; axis < 2; ++axis) {
            const double step = landing[axis] > 0 ? -kStep : kStep;
            const auto moved = offsetPx(projection_, candidate.screenFromRay, px + step * axes[axis]);
            if (moved && std::isfinite(moved->x)) {
                const glm::dvec2 slope = (1 - place.inwards) / step * (*moved - *off);
                set(axis, (1 - place.along) * slope);
                set(2 + axis, place.along * slope);
            }
            set(4 + 3 * axis, landing.x * axes[axis]);
            set(5 + 3 * axis, landing.y * axes[axis]);
            set(6 + 3 * axis, axes[axis]);
            set(10 + axis, -landing[axis] * (axes * landing));
        }
        const Eigen::Matrix<double, 12, 1> pull = slopes.transpose() * Eigen::Vector2d(off->x, off->y);
        const double slack = tolerancePx_ * tolerancePx_ - glm::dot(*off, *off);
        const double weight = 2 * barrier / slack;
        const Eigen::Matrix<double, 12, 12> block =
            weight * (slopes.transpose() * slopes + 2 / slack * pull * pull.transpose());
        const std::array<Eigen::Index, 3> to{unknownOf(place.corner), unknownOf(after(place.corner)), kMoves};
        constexpr std::array<Eigen::Index, 3> kFrom{0, 2, 4}, kCount{2, 2, 8};
        for (size_t i = 0; i < 3; ++i) {
            sum.gradient.segment(to[i], kCount[i]) += weight * pull.segment(kFrom[i], kCount[i]);
            for (size_t j = 0; j < 3; ++j)
                sum.hessian.block(to[i], to[j], kCount[i], kCount[j]) +=
                    block.block(kFrom[i], kFrom[j], kCount[i], kCount[j]);
        }
    }
}

Candidate moved(const Candidate& candidate, const Frame& frame, const Vector& move) {
    Candidate next;
    for (size_t k = 0; k < kCorners; ++k) {
        const Eigen::Index i = unknownOf(k);
        next.corners[k] = candidate.corners[k] + frame.pxFromFrame * glm::dvec2(move[i], move[i + 1]);
    }
    const Eigen::Matrix<double, 8, 1> d = move.tail<8>();
    const glm::dmat3 change(1 + d[0], d[3], d[6], d[1], 1 + d[4], d[7], d[2], d[5], 1);
    const glm::dmat3 pxFromFrame({frame.pxFromFrame[0], 0}, {frame.pxFromFrame[1], 0}, {frame.originPx, 1});
    next.screenFromRay = pxFromFrame * change * glm::inverse(pxFromFrame) * candidate.screenFromRay;
    return next;
}

bool CellSearch::grow(Candidate& candidate, double barrier) {
    constexpr int kDampings = 8, kHalvings = 4;
    constexpr double kLeastDamping = 1e-8;
    const Frame frame = frameOf(candidate.corners);
    useSidesNear(frame);
    const double now = value(candidate, frame, barrier);
    const Quadratic quadratic = quadraticAt(candidate, frame, barrier);
    for (int i = 0; i < kDampings; ++i, damping_ *= 10) {
        Matrix damped = quadratic.hessian;
        damped.diagonal().array() += damping_;
        const Vector move = damped.ldlt().solve(-quadratic.gradient);
        if (!move.allFinite()) continue;
        double length = std::min(1.0, kLongestMove / move.head<kMoves>().cwiseAbs().maxCoeff());
        for (int halving = 0; halving < kHalvings; ++halving, length *= 0.5) {
            const Candidate next = moved(candidate, frame, length * move);
            const double then = value(next, frame, barrier);
            if (!(then < now)) continue;
            candidate = next;
            if (halving == 0) damping_ = std::max(kLeastDamping, 0.2 * damping_);
            return now - then > 0.1 * barrier;
        }
    }
    return false;
}

}  // namespace

double PixelWeight::at(glm::dvec2 px) const {
    const double base = (glm::dot(direction, px) - originPx) / reachPx;
    double product = 1;
    for (int i = 0; i < power; ++i) product *= base;
    return product;
}

bool ConvexCell::has(glm::dvec2 px) const {
    for (size_t k = 0; k < corners.size(); ++k)
        if (cross(corners[(k + 1) % corners.size()] - corners[k], px - corners[k]) < 0) return false;
    return true;
}

std::optional<ConvexCell> largestCell(const Projection& projection, const std::vector<HalfPlane>& outline,
                                      const PixelWeight& weight, glm::dvec2 px, double tolerancePx,
                                      glm::dvec2 stretch) {
    constexpr int kMostSteps = 20;
    CellSearch search(projection, outline, weight, px, tolerancePx);
    std::optional<Candidate> found = search.first(stretch);
    if (!found) return std::nullopt;
    for (double barrier : {0.1, 0.03, 0.01, 0.003, 0.001, 0.0003, 0.0001})
        for (int i = 0; i < kMostSteps; ++i)
            if (!search.grow(*found, barrier)) break;
    return ConvexCell{{found->corners.begin(), found->corners.end()},
                      weightOf(found->corners, weight),
                      found->screenFromRay};
}

double errorPx(const Projection& projection, const glm::dmat3& screenFromRay, glm::dvec2 px) {
    const auto off = offsetPx(projection, screenFromRay, px);
    return off ? glm::length(*off) : 0;
}

}  // namespace curvewall
