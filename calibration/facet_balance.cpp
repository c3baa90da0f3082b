#include "calibration/facet_balance.h"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace curvewall {
namespace {

constexpr int kLattice = 4;  // samples per piece edge, less one
constexpr int kIterations = 24;

// A screen position inside a piece, as a blend of its vertices, with the ray that the display shows there.
struct Sample {
    size_t piece;
    std::array<double, 4> blend;
    glm::dvec2 px;
    glm::dvec3 ray;
    double weight;
};

std::vector<std::array<double, 4>> latticeBlends(uint32_t vertexCount) {
    std::vector<std::array<double, 4>> blends;
    for (int i = 0; i <= kLattice; ++i) {
        for (int j = 0; j <= (vertexCount == 3 ? kLattice - i : kLattice); ++j) {
            const double u = double(i) / kLattice, v = double(j) / kLattice;
            if (vertexCount == 3)
                blends.push_back({1 - u - v, u, v, 0});
            else
                blends.push_back({(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v});
        }
    }
    return blends;
}

std::vector<Sample> samplesOf(const Projection& projection, const PieceMesh& mesh) {
    std::vector<Sample> samples;
    for (size_t k = 0; k < mesh.pieces.size(); ++k) {
        const Piece& piece = mesh.pieces[k];
        for (const auto& blend : latticeBlends(piece.vertexCount)) {
            glm::dvec2 px(0);
            for (uint32_t i = 0; i < piece.vertexCount; ++i)
                px += blend[i] * mesh.vertices[piece.vertices[i]].s;
            if (const auto ray = projection.unproject(px)) samples.push_back({k, blend, px, *ray, 1});
        }
    }
    return samples;
}

struct Landing {
    glm::dvec2 errorPx;
    glm::dmat3x2 pxPerM;  // how the landing moves when the facet's point under the ray moves
};

// Infinite error where the ray points away from the facet.
Landing land(const glm::dmat3& h, const Sample& sample) {
    const glm::dvec3 seen = h * sample.ray;
    if (!(seen.z > 0)) return {glm::dvec2(std::numeric_limits<double>::infinity()), glm::dmat3x2(0)};
    const glm::dvec2 px = glm::dvec2(seen) / seen.z;
    glm::dmat3x2 pxPerM;
    for (int c = 0; c < 3; ++c) pxPerM[c] = glm::dvec2(h[c]) - px * h[c].z;
    return {px - sample.px, pxPerM};
}

bool facesTheEye(const PieceMesh& mesh) {
    bool positive = false, negative = false;
    for (const Piece& piece : mesh.pieces) {
        const auto m = [&](uint32_t i) { return mesh.vertices[piece.vertices[i]].m; };
        const double det = glm::determinant(glm::dmat3(m(0), m(1), m(2)));
        positive |= det > 0;
        negative |= det < 0;
        if (det == 0) return false;
    }
    return positive != negative;
}

// The unknowns that move a vertex: its own point, or for a grid of exact quads the u of its column and the v
// of its row. Each is three numbers.
class Motion {
public:
    Motion(const PieceGrid& grid, bool keepsQuads)
        : columns_(static_cast<size_t>(grid.columns) + 1),
          rows_(static_cast<size_t>(grid.rows) + 1),
          keepsQuads_(keepsQuads) {}

    size_t blockCount() const { return keepsQuads_ ? columns_ + rows_ : columns_ * rows_; }
    std::vector<size_t> blocksOf(size_t vertex) const {
        if (!keepsQuads_) return {vertex};
        return {vertex % columns_, columns_ + vertex / columns_};
    }

private:
    size_t columns_, rows_;
    bool keepsQuads_;
};

// One weighted Gauss-Newton step; returns the movement of every unknown.
Eigen::VectorXd solveStep(const PieceMesh& mesh, const std::vector<Sample>& samples, const Motion& motion) {
    const auto size = static_cast<Eigen::Index>(3 * motion.blockCount());
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd target(static_cast<Eigen::Index>(2 * samples.size()));
    for (size_t row = 0; row < samples.size(); ++row) {
        const Sample& sample = samples[row];
        const Piece& piece = mesh.pieces[sample.piece];
        const Landing landing = land(piece.screenFromRay, sample);
        const double root = std::sqrt(sample.weight);
        for (int axis = 0; axis < 2; ++axis) {
            const auto line = static_cast<int>(2 * row) + axis;
            target[line] = root * landing.errorPx[axis];
            for (uint32_t i = 0; i < piece.vertexCount; ++i)
                for (size_t block : motion.blocksOf(piece.vertices[i]))
                    for (int c = 0; c < 3; ++c)
                        entries.emplace_back(line, static_cast<int>(3 * block) + c,
                                             root * sample.blend[i] * landing.pxPerM[c][axis]);
        }
    }
    Eigen::SparseMatrix<double> jacobian(target.size(), size);
    jacobian.setFromTriplets(entries.begin(), entries.end());
    Eigen::SparseMatrix<double> normal = jacobian.transpose() * jacobian;
    // Some motions change nothing on the screen; a trace of damping picks one answer.
    const double damping = 1e-9 * normal.diagonal().maxCoeff();
    for (Eigen::Index i = 0; i < size; ++i) normal.coeffRef(i, i) += damping;
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(normal).solve(jacobian.transpose() * target);
}

double summedDistanceM(const std::vector<PieceVertex>& vertices) {
    double sum = 0;
    for (const PieceVertex& vertex : vertices) sum += glm::length(vertex.m);
    return sum;
}

// Scaling all points about the eye changes nothing on the screen, so a step may drift that way; the facets
// stay as far from the eye as the wall, for depth is measured by them.
void moveVertices(std::vector<PieceVertex>& vertices, const Motion& motion, const Eigen::VectorXd& step) {
    const double distanceM = summedDistanceM(vertices);
    for (size_t v = 0; v < vertices.size(); ++v)
        for (size_t block : motion.blocksOf(v))
            for (int c = 0; c < 3; ++c) vertices[v].m[c] += step[static_cast<Eigen::Index>(3 * block) + c];
    const double scale = distanceM / summedDistanceM(vertices);
    for (PieceVertex& vertex : vertices) vertex.m *= scale;
}

// Lawson: a sample's weight grows with its error, so the fit turns towards the worst ones.
double reweight(const PieceMesh& mesh, std::vector<Sample>& samples) {
    double worst = 0, total = 0;
    for (Sample& sample : samples) {
        const double error = glm::length(land(mesh.pieces[sample.piece].screenFromRay, sample).errorPx);
        worst = std::max(worst, error);
        sample.weight *= error;
        total += sample.weight;
    }
    for (Sample& sample : samples)
        sample.weight *= static_cast<double>(samples.size()) / std::max(total, 1e-300);
    return worst;
}

}  // namespace

BalancedPieces balanceFacets(const Projection& projection, const PieceGrid& grid) {
    PieceMesh mesh = meshFromGrid(grid.sizePx, grid.vertices, grid.columns, grid.rows);
    const bool keepsQuads =
        mesh.pieces.size() == static_cast<size_t>(grid.columns) * static_cast<size_t>(grid.rows);
    const Motion motion(grid, keepsQuads);
    std::vector<Sample> samples = samplesOf(projection, mesh);

    BalancedPieces best{mesh, std::numeric_limits<double>::infinity()};
    for (int i = 0; i < kIterations; ++i) {
        std::vector<Sample> weighted = samples;
        const double worst = reweight(mesh, weighted);
        if (!facesTheEye(mesh) || !std::isfinite(worst)) break;
        if (worst < best.sampledMaxPx) best = {mesh, worst};
        if (worst < 1e-9) break;
        if (i > 0) samples = std::move(weighted);  // the first step is the plain least squares fit
        std::vector<PieceVertex> moved = mesh.vertices;
        moveVertices(moved, motion, solveStep(mesh, samples, motion));
        mesh = meshFromGrid(grid.sizePx, std::move(moved), grid.columns, grid.rows);
        if (mesh.pieces.size() != best.mesh.pieces.size()) break;
    }
    return best;
}

}  // namespace curvewall
