#include "calibration/pieces/facet_following.h"

#include <Eigen/Sparse>
#include <Eigen/SparseCholesky>
#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace curvewall {
namespace {

using Shifts = std::vector<glm::dvec3>;  // NaN: not known

bool isKnown(const glm::dvec3& shift) { return std::isfinite(shift.x + shift.y + shift.z); }

// Ring by ring, each the mean of those that its pieces know.
void spread(Shifts& shifts, const PieceMesh& mesh) {
    for (bool isDone = false; !isDone;) {
        isDone = true;
        Shifts sums(shifts.size(), glm::dvec3(0));
        std::vector<int> counts(shifts.size());
        for (const Piece& piece : mesh.pieces)
            for (uint32_t i = 0; i < piece.vertexCount; ++i)
                for (uint32_t j = 0; j < piece.vertexCount; ++j)
                    if (const uint32_t a = piece.vertices[i], b = piece.vertices[j];
                        !isKnown(shifts[a]) && isKnown(shifts[b])) {
                        sums[a] += shifts[b];
                        ++counts[a];
                    }
        for (size_t v = 0; v < shifts.size(); ++v) {
            if (counts[v] == 0) continue;
            shifts[v] = sums[v] / double(counts[v]);
            isDone = false;
        }
    }
    for (glm::dvec3& shift : shifts)
        if (!isKnown(shift)) shift = glm::dvec3(0);
}

// What the unknowns of a motion add, by least squares. Where several add up to the same, as the columns and
// rows of a grid do, a trace of damping chooses.
Eigen::MatrixX3d unknownShifts(const Shifts& shifts, const Motion& motion) {
    constexpr double kTrace = 1e-9;
    const auto count = static_cast<Eigen::Index>(motion.unknownCount());
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(motion.unknownCount() + 2 * shifts.size());
    Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(count, 3);
    for (int i = 0; i < count; ++i) entries.emplace_back(i, i, kTrace);
    for (size_t v = 0; v < shifts.size(); ++v) {
        for (const Motion::Term& a : motion.termsOf(v)) {
            for (int c = 0; c < 3; ++c) right(a.unknown, c) += a.weight * shifts[v][c];
            for (const Motion::Term& b : motion.termsOf(v))
                if (a.unknown >= b.unknown)
                    entries.emplace_back(static_cast<int>(a.unknown), static_cast<int>(b.unknown),
                                         a.weight * b.weight);
        }
    }
    Eigen::SparseMatrix<double> normal(count, count);
    normal.setFromTriplets(entries.begin(), entries.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(normal).solve(right);
}

}  // namespace

void follow(PieceMesh& mesh, const Motion& motion, const std::vector<glm::dvec3>& raysBefore,
            const std::vector<glm::dvec3>& raysNow) {
    Shifts shifts;
    shifts.reserve(mesh.vertices.size());
    for (size_t v = 0; v < mesh.vertices.size(); ++v)
        shifts.push_back(glm::length(mesh.vertices[v].m) / glm::length(raysBefore[v]) *
                         (raysNow[v] - raysBefore[v]));
    spread(shifts, mesh);
    const Eigen::MatrixX3d added = unknownShifts(shifts, motion);
    for (size_t v = 0; v < mesh.vertices.size(); ++v) {
        if (motion.termsOf(v).empty()) mesh.vertices[v].m += shifts[v];
        for (const Motion::Term& term : motion.termsOf(v))
            for (int c = 0; c < 3; ++c) mesh.vertices[v].m[c] += term.weight * added(term.unknown, c);
    }
    updateHomographies(mesh);
}

}  // namespace curvewall
