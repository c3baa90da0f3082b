#pragma once
// Displays that are round about one point: fisheyes of any radial model, cameras. Over the flat screen of a
// RadialMap they are a height, and the lowest of many planes near that height is a continuous screen of
// convex facets, nearly as few as the thinnest covering with hexagons has.

#include "calibration/pieces/piece_mesh.h"
#include "calibration/projections/projection.h"

#include <optional>
#include <stop_token>

namespace curvewall {

// The fewest pieces found whose error is at most the tolerance at the samples of the fit, each of at most
// kMostPieceEdges edges. Nothing where the display is not round or bends both ways. Throws UsageError where
// that takes too many, and FitStopped.
std::optional<PieceMesh> fitRadial(const Projection& projection, glm::ivec2 sizePx, double tolerancePx,
                                   const std::stop_token& stop = {});

}  // namespace curvewall
