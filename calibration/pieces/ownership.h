#pragma once
// Which piece owns a pixel: decided once a mesh, exactly, in integers.

#include "calibration/pieces/piece_mesh.h"

#include <cstdint>
#include <vector>

namespace curvewall {

inline constexpr int32_t kNoPiece = -1;

// The piece that owns each pixel centre, row by row from the top, or kNoPiece. Vertices are on the 1/256 px
// grid, so edge functions are exact; a centre on an edge goes by the top-left rule, so that pieces which meet
// edge to edge own every centre once. Where pieces overlap (a fold), the later one owns.
std::vector<int32_t> ownerImage(const PieceMesh& mesh);

}  // namespace curvewall
