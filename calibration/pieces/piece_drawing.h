#pragma once
// A piece mesh for people and for other programs.

#include "calibration/pieces/piece_mesh.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace curvewall {

// {"size": [w, h], "vertices": [{"m": [x, y, z], "s": [x, y]}], "pieces": [[vertex, ...]]}
nlohmann::json piecesAsJson(const PieceMesh& mesh);

// Outlines at the display's size, in the display's pixels.
std::string piecesAsSvg(const PieceMesh& mesh);

}  // namespace curvewall
