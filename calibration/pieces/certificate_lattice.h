#pragma once
// A certificate over every so many-th row and column, which can be brought up to date piece by piece.

#include "calibration/pieces/certificate.h"
#include "calibration/projections/projection.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <limits>
#include <stop_token>
#include <utility>
#include <vector>

namespace curvewall {

class CertificateLattice {
public:
    // Measures every pixel of the lattice. `owners` is of all pixels. May leave out the rest soon after an
    // error above `hopelessPx`, for meshes that nobody wants then. Throws FitStopped soon after a stop is
    // requested.
    CertificateLattice(const Projection& projection, const PieceMesh& mesh,
                       const std::vector<int32_t>& owners, int every, double hopelessPx,
                       const std::stop_token& stop);

    // Measures those of some pieces again, after their facets have changed.
    void update(const PieceMesh& mesh, const std::vector<uint32_t>& pieces);

    struct Failure {
        uint32_t piece;
        glm::ivec2 px;  // where it is off by most
        float errorPx;
    };
    // The pieces that are off by more than the tolerance, in their order.
    std::vector<Failure> failures(double tolerancePx) const;

    // Whether pixels have a ray and no piece, or a piece and no ray.
    bool outlineHasMoved() const { return outlineHasMoved_; }

    // Whether no pixel of the lattice has a ray.
    bool isEmpty() const;

    Certificate certificate() const;

    // Row by row; of every pixel of the display where it looks at each.
    std::vector<float> takeErrorsPx() && { return std::move(errorsPx_); }

private:
    glm::ivec2 pixelOf(glm::ivec2 node) const { return node * every_; }
    size_t indexOf(glm::ivec2 node) const {
        return static_cast<size_t>(node.y) * static_cast<size_t>(counts_.x) + static_cast<size_t>(node.x);
    }
    float errorAt(const PieceMesh& mesh, glm::ivec2 node) const;

    const Projection& projection_;
    int every_;
    glm::ivec2 counts_;
    std::vector<int32_t> owners_;  // of the lattice
    std::vector<float> errorsPx_;
    bool outlineHasMoved_ = false;
};

}  // namespace curvewall
