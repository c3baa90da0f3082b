#pragma once
// Any display: cells that are cut where the error is, with two facets each.

#include "calibration/pieces/piece_mesh.h"
#include "calibration/pieces/ray_image.h"

#include <stop_token>

namespace curvewall {

// Pieces whose error is at most the tolerance at every pixel, and of which each pixel with a ray has one.
// Throws UsageError where that takes more than kMostPieces, and FitStopped.
PieceMesh fitCells(const RayImage& rays, double tolerancePx, const std::stop_token& stop = {});

}  // namespace curvewall
