#pragma once
// Moves the facets' vertices so that the largest error over the display becomes small.

#include "calibration/pieces/piece_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

namespace curvewall {

// How the vertices of a mesh may move in space: each by a weighted sum of unknowns of three numbers. A free
// vertex has an unknown of its own; constraints are vertices that share theirs.
class Motion {
public:
    struct Term {
        uint32_t unknown;
        double weight;
    };

    // The next vertex's.
    void addVertex(std::span<const Term> terms);

    size_t unknownCount() const { return unknownCount_; }
    std::span<const Term> termsOf(size_t vertex) const {
        return std::span(terms_).subspan(starts_[vertex], starts_[vertex + 1] - starts_[vertex]);
    }

private:
    size_t unknownCount_ = 0;
    std::vector<size_t> starts_{0};
    std::vector<Term> terms_;
};

// A screen position in a piece, as a blend of its vertices, with the ray that the display shows there.
struct FacetSample {
    uint32_t piece = 0;
    std::array<double, kMostPieceEdges> blend{};
    glm::dvec2 px{0};
    glm::dvec3 ray{0};
};

struct BalancedPieces {
    PieceMesh mesh;
    double sampledMaxPx = 0;  // over the samples that the fit could use
};

// Vertices keep their screen positions; their points m move in three dimensions, as `motion` allows, and
// those that it gives no terms stay where they are. Gauss-Newton steps on the true screen error with Lawson's
// reweighting lead from the least squares fit towards the smallest maximum (C. L. Lawson, 1961), which ends
// where it is at most `goodEnoughPx` or hopelessly far from it. Facets keep the side that they turn to the
// eye; those that are edge-on to begin with are left as they are. Samples come piece by piece. Throws
// FitStopped soon after a stop is requested.
BalancedPieces balanceFacets(PieceMesh mesh, const Motion& motion, const std::vector<FacetSample>& samples,
                             double goodEnoughPx, const std::stop_token& stop = {});

}  // namespace curvewall
