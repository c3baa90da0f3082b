#pragma once
// The geometric error of a piece mesh, measured at every pixel centre by the piece that owns it.

#include "calibration/pieces/piece_mesh.h"
#include "calibration/pieces/ray_image.h"

#include <glm/vec2.hpp>

#include <cstdint>
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

// |H_k r(p) - p| at every pixel centre p, k being its owner; row by row from the top. NaN in holes,
// infinity where a pixel with a ray has no piece or its ray points away from the piece.
std::vector<float> pieceErrorsPx(const RayImage& rays, const PieceMesh& mesh,
                                 const std::vector<int32_t>& owners);

// Pixels without a piece are counted and left out of the three figures.
Certificate certificateOf(const std::vector<float>& errorsPx, const std::vector<int32_t>& owners,
                          glm::ivec2 sizePx);

}  // namespace curvewall
