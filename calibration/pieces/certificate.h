#pragma once
// The geometric error of a piece mesh, measured at every pixel centre by the piece that owns it.

#include "calibration/pieces/piece_mesh.h"
#include "calibration/projections/projection.h"

#include <glm/vec2.hpp>

#include <cstdint>
#include <stop_token>
#include <vector>

namespace curvewall {

struct Certificate {
    double maxPx = 0;
    double p99Px = 0;
    double meanPx = 0;
    glm::ivec2 maxAt{0};      // the pixel with the largest error
    int every = 1;            // it looked at every so many-th row and column, from the first
    int uncoveredPixels = 0;  // with a ray but without a piece
    int holes = 0;            // without a ray
};

// Row by row from the top.
struct CertifiedPixels {
    std::vector<int32_t> owners;  // see ownership.h; kNoPiece in holes
    // |H_k r(p) - p| at the pixel's centre p, k being its owner. NaN in holes, infinity where a pixel with a
    // ray has no piece or its ray points away from the piece.
    std::vector<float> errorsPx;
    Certificate certificate;
};

// Looks at the pixels in every `every`-th row and column and at no other. Rays are computed as they are
// needed and not kept. Throws FitStopped soon after a stop is requested.
CertifiedPixels certifyPieces(const Projection& projection, const PieceMesh& mesh,
                              const std::stop_token& stop = {}, int every = 1);

// The figures of such images. Pixels without a piece are counted and left out of the first three.
Certificate certificateOf(const std::vector<float>& errorsPx, const std::vector<int32_t>& owners,
                          glm::ivec2 sizePx, int every = 1);

}  // namespace curvewall
