#include "calibration/pieces/facet_balance.h"

#include "calibration/pieces/fit_stop.h"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace curvewall {
namespace {

constexpr int kIterations = 24;
constexpr int kPatience = 4;         // steps without progress before the fit ends
constexpr double kProgress = 0.995;  // what the maximum must fall below, of the best so far
constexpr int kFirstSteps = 3;       // after which the fit is about as good as least squares make it
constexpr double kMostGain = 8;      // of what follows
constexpr int kHalvings = 6;         // of a step that would turn a facet over

struct Landing {
    glm::dvec2 errorPx;
    glm::dmat3x2 pxPerM;  // how the landing moves when the facet's point under the ray moves
};

// Infinite error where the ray points away from the facet.
Landing land(const glm::dmat3& h, const FacetSample& sample) {
    const glm::dvec3 seen = h * sample.ray;
    if (!(seen.z > 0)) return {glm::dvec2(std::numeric_limits<double>::infinity()), glm::dmat3x2(0)};
    const glm::dvec2 px = glm::dvec2(seen) / seen.z;
    glm::dmat3x2 pxPerM;
    for (int c = 0; c < 3; ++c) pxPerM[c] = glm::dvec2(h[c]) - px * h[c].z;
    return {px - sample.px, pxPerM};
}

std::vector<double> landingErrorsPx(const PieceMesh& mesh, const std::vector<FacetSample>& samples) {
    std::vector<double> errors;
    errors.reserve(samples.size());
    for (const FacetSample& sample : samples)
        errors.push_back(glm::length(land(mesh.pieces[sample.piece].screenFromRay, sample).errorPx));
    return errors;
}

// The normal equations of one weighted Gauss-Newton step, lower triangle.
class NormalEquations {
public:
    explicit NormalEquations(size_t unknowns) : right_(Eigen::VectorXd::Zero(3 * Eigen::Index(unknowns))) {}

    // Adds the samples of one piece.
    void addPiece(const PieceMesh& mesh, const Motion& motion, std::span<const FacetSample> samples,
                  std::span<const double> weights) {
        const Piece& piece = mesh.pieces[samples.front().piece];
        std::array<std::array<Eigen::Matrix3d, kMostPieceEdges>, kMostPieceEdges> normal;
        std::array<Eigen::Vector3d, kMostPieceEdges> right;
        for (size_t i = 0; i < piece.vertexCount; ++i) {
            right[i].setZero();
            for (size_t j = 0; j < piece.vertexCount; ++j) normal[i][j].setZero();
        }
        for (size_t k = 0; k < samples.size(); ++k) {
            const Landing landing = land(piece.screenFromRay, samples[k]);
            Eigen::Matrix<double, 2, 3> jacobian;
            for (int c = 0; c < 3; ++c)
                jacobian.col(c) = Eigen::Vector2d(landing.pxPerM[c].x, landing.pxPerM[c].y);
            const Eigen::Matrix3d squared = weights[k] * jacobian.transpose() * jacobian;
            const Eigen::Vector3d pull =
                weights[k] * jacobian.transpose() * Eigen::Vector2d(landing.errorPx.x, landing.errorPx.y);
            for (size_t i = 0; i < piece.vertexCount; ++i) {
                right[i] += samples[k].blend[i] * pull;
                for (size_t j = 0; j < piece.vertexCount; ++j)
                    normal[i][j] += samples[k].blend[i] * samples[k].blend[j] * squared;
            }
        }
        for (size_t i = 0; i < piece.vertexCount; ++i) {
            for (const Motion::Term& a : motion.termsOf(piece.vertices[i])) {
                right_.segment<3>(3 * Eigen::Index(a.unknown)) += a.weight * right[i];
                for (size_t j = 0; j < piece.vertexCount; ++j)
                    for (const Motion::Term& b : motion.termsOf(piece.vertices[j]))
                        if (a.unknown >= b.unknown)
                            scatter(a.unknown, b.unknown, a.weight * b.weight * normal[i][j]);
            }
        }
    }

    // The movement of every unknown.
    Eigen::VectorXd solve() {
        // Unknowns without a sample get their place on the diagonal now: later it would cost a copy each.
        for (int i = 0; i < right_.size(); ++i) entries_.emplace_back(i, i, 0.0);
        Eigen::SparseMatrix<double> normal(right_.size(), right_.size());
        normal.setFromTriplets(entries_.begin(), entries_.end());
        // Some motions change nothing on the screen and others next to nothing, which would grow and hide
        // what they cost to second order; damping keeps them small.
        const double damping = 1e-4 * normal.diagonal().maxCoeff();
        for (Eigen::Index i = 0; i < right_.size(); ++i) normal.coeffRef(i, i) += damping;
        return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(normal).solve(right_);
    }

private:
    void scatter(uint32_t row, uint32_t column, const Eigen::Matrix3d& block) {
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < (row == column ? i + 1 : 3); ++j)
                entries_.emplace_back(static_cast<int>(3 * row) + i, static_cast<int>(3 * column) + j,
                                      block(i, j));
    }

    Eigen::VectorXd right_;
    std::vector<Eigen::Triplet<double>> entries_;
};

Eigen::VectorXd solveStep(const PieceMesh& mesh, const Motion& motion, std::span<const FacetSample> samples,
                          std::span<const double> weights) {
    NormalEquations equations(motion.unknownCount());
    for (size_t begin = 0; begin < samples.size();) {
        size_t end = begin;
        while (end < samples.size() && samples[end].piece == samples[begin].piece) ++end;
        equations.addPiece(mesh, motion, samples.subspan(begin, end - begin),
                           weights.subspan(begin, end - begin));
        begin = end;
    }
    return equations.solve();
}

double summedDistanceM(const std::vector<PieceVertex>& vertices) {
    double sum = 0;
    for (const PieceVertex& vertex : vertices) sum += glm::length(vertex.m);
    return sum;
}

// A vertex may move by a part of its shortest edge at a time, so that one with few samples, which the normal
// equations hardly hold, does not turn its facets over.
void limitStep(Eigen::VectorXd& step, const PieceMesh& mesh, const Motion& motion) {
    constexpr double kLargestPart = 0.25;
    std::vector<double> limits(motion.unknownCount(), std::numeric_limits<double>::infinity());
    for (const Piece& piece : mesh.pieces) {
        for (uint32_t i = 0; i < piece.vertexCount; ++i) {
            const uint32_t a = piece.vertices[i], b = piece.vertices[(i + 1) % piece.vertexCount];
            const double limit = kLargestPart * glm::distance(mesh.vertices[a].m, mesh.vertices[b].m);
            for (uint32_t vertex : {a, b})
                for (const Motion::Term& term : motion.termsOf(vertex))
                    limits[term.unknown] = std::min(limits[term.unknown], limit);
        }
    }
    for (size_t i = 0; i < limits.size(); ++i) {
        auto part = step.segment<3>(3 * static_cast<Eigen::Index>(i));
        if (const double length = part.norm(); length > limits[i]) part *= limits[i] / length;
    }
}

// Whether a piece ties points that move to points that stay.
bool isHeld(const PieceMesh& mesh, const Motion& motion) {
    return std::ranges::any_of(mesh.pieces, [&](const Piece& piece) {
        const auto moves = [&](uint32_t i) { return !motion.termsOf(piece.vertices[i]).empty(); };
        for (uint32_t i = 1; i < piece.vertexCount; ++i)
            if (moves(i) != moves(0)) return true;
        return false;
    });
}

// Scaling all points about the eye changes nothing on the screen, so a step may drift that way; the facets
// stay as far from the eye as the wall, for depth is measured by them. Points that stay hold the others
// there.
PieceMesh moved(PieceMesh mesh, const Motion& motion, const Eigen::VectorXd& step, double length) {
    const double distanceM = summedDistanceM(mesh.vertices);
    for (size_t v = 0; v < mesh.vertices.size(); ++v)
        for (const Motion::Term& term : motion.termsOf(v))
            for (int c = 0; c < 3; ++c)
                mesh.vertices[v].m[c] += length * term.weight * step[3 * Eigen::Index(term.unknown) + c];
    if (!isHeld(mesh, motion)) {
        const double scale = distanceM / summedDistanceM(mesh.vertices);
        for (PieceVertex& vertex : mesh.vertices) vertex.m *= scale;
    }
    updateHomographies(mesh);
    return mesh;
}

// The sign of det[m], by which a facet turns one side to the eye or the other.
int sideOf(const PieceMesh& mesh, const Piece& piece) {
    const auto [a, b, c] = widestTriangle(mesh, piece);
    const double det = glm::determinant(glm::dmat3(a.m, b.m, c.m));
    return (det > 0) - (det < 0);
}

bool sameSides(const PieceMesh& a, const PieceMesh& b) {
    for (size_t k = 0; k < a.pieces.size(); ++k)
        if (sideOf(a, a.pieces[k]) != sideOf(b, b.pieces[k])) return false;
    return true;
}

// Lawson: a sample's weight grows with its error, so the fit turns towards the worst ones.
void reweight(std::vector<double>& weights, const std::vector<double>& errors) {
    double total = 0;
    for (size_t i = 0; i < weights.size(); ++i) total += weights[i] *= errors[i];
    for (double& weight : weights) weight *= static_cast<double>(weights.size()) / std::max(total, 1e-300);
}

// Facets that are edge-on or turned away to begin with cannot be fitted; the rest can.
std::vector<FacetSample> usableSamples(const PieceMesh& mesh, const std::vector<FacetSample>& samples) {
    std::vector<bool> unusable(mesh.pieces.size());
    for (const FacetSample& sample : samples)
        if (!std::isfinite(glm::length(land(mesh.pieces[sample.piece].screenFromRay, sample).errorPx)))
            unusable[sample.piece] = true;
    std::vector<FacetSample> usable;
    std::ranges::copy_if(samples, std::back_inserter(usable),
                         [&](const FacetSample& sample) { return !unusable[sample.piece]; });
    return usable;
}

}  // namespace

void Motion::addVertex(std::span<const Term> terms) {
    terms_.insert(terms_.end(), terms.begin(), terms.end());
    starts_.push_back(terms_.size());
    for (const Term& term : terms) unknownCount_ = std::max(unknownCount_, size_t{term.unknown} + 1);
}

BalancedPieces balanceFacets(PieceMesh mesh, const Motion& motion, const std::vector<FacetSample>& all,
                             double goodEnoughPx, const std::stop_token& stop) {
    const std::vector<FacetSample> samples = usableSamples(mesh, all);
    BalancedPieces best{mesh, std::numeric_limits<double>::infinity()};
    std::vector<double> weights(samples.size(), 1);
    for (int i = 0, idle = 0; i < kIterations && idle < kPatience; ++i) {
        throwIfStopped(stop);
        const std::vector<double> errors = landingErrorsPx(mesh, samples);
        const double worst = errors.empty() ? 0 : std::ranges::max(errors);
        if (!std::isfinite(worst)) break;
        idle = worst < kProgress * best.sampledMaxPx ? 0 : idle + 1;
        if (worst < best.sampledMaxPx) best = {mesh, worst};
        if (worst <= std::max(goodEnoughPx, 1e-9)) break;
        if (i >= kFirstSteps && goodEnoughPx > 0 && best.sampledMaxPx > kMostGain * goodEnoughPx) break;
        if (i > 0) reweight(weights, errors);  // the first step is the plain least squares fit
        Eigen::VectorXd step = solveStep(mesh, motion, samples, weights);
        if (!step.allFinite()) break;
        limitStep(step, mesh, motion);
        PieceMesh next = moved(mesh, motion, step, 1);
        for (int halving = 1; halving <= kHalvings && !sameSides(mesh, next); ++halving)
            next = moved(mesh, motion, step, std::ldexp(1.0, -halving));
        if (!sameSides(mesh, next)) break;
        mesh = std::move(next);
    }
    return best;
}

}  // namespace curvewall
