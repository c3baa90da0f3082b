#pragma once
// Any display: cells that are cut where the error is, with two facets each.

#include "calibration/pieces/certificate.h"

#include <stop_token>

namespace curvewall {

struct CertifiedCells {
    PieceMesh mesh;
    CertifiedPixels pixels;
    double certifyMs = 0;  // what the last look at every pixel took
};

// Pieces whose error is at most the tolerance at every pixel, and of which each pixel with a ray has one.
// Throws UsageError where that takes more than kMostPieces or no pixel has a ray, and FitStopped.
CertifiedCells fitCells(const Projection& projection, glm::ivec2 sizePx, double tolerancePx,
                        const std::stop_token& stop = {});

}  // namespace curvewall
