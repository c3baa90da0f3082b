#pragma once
// A few pieces of a mesh, taken out to be balanced while the rest stays.

#include "calibration/pieces/facet_balance.h"

#include <cstdint>
#include <vector>

namespace curvewall {

class FacetPatch {
public:
    // The vertices of `centre` may move, and those of the pieces in as many rings around it. What else these
    // move with them belongs to the patch too, and is held where it meets the rest.
    FacetPatch(const PieceMesh& whole, const Motion& motion, std::vector<uint32_t> centre, int rings);

    // Of the whole mesh, in order. Piece i of the patch is this list's i-th.
    const std::vector<uint32_t>& pieces() const { return pieces_; }

    // Samples are of the patch's own pieces.
    void balance(const std::vector<FacetSample>& samples, double goodEnoughPx, const std::stop_token& stop);

    void putBack(PieceMesh& whole) const;

private:
    std::vector<uint32_t> pieces_;
    std::vector<uint32_t> vertices_;  // of the whole mesh
    PieceMesh mesh_;
    Motion motion_;
};

}  // namespace curvewall
