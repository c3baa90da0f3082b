#pragma once
// From a projection and a tolerance to certified pieces.

#include "calibration/pieces/certificate.h"
#include "calibration/pieces/fit_stop.h"
#include "calibration/wall.h"

namespace curvewall {

struct FittedPieces {
    PieceMesh mesh;
    std::vector<int32_t> owners;  // see ownership.h
    std::vector<float> errorsPx;  // see certificate.h
    Certificate certificate;      // its maximum is at most the tolerance
    double fitMs = 0;
    double certifyMs = 0;
};

inline constexpr int kMostPieces = 200'000;

// Few pieces whose certified maximum is at most `tolerancePx`. Throws UsageError when that would take more
// than kMostPieces, or when no pixel of the display has a ray, and FitStopped soon after a stop is requested.
FittedPieces fitPieces(const Projection& projection, glm::ivec2 sizePx, double tolerancePx,
                       const std::stop_token& stop = {});

// The same for a display of a wall, whose name such errors begin with.
FittedPieces fitPieces(const Display& display, double tolerancePx, const std::stop_token& stop = {});

// Throws the UsageError of a tolerance that takes too many pieces.
[[noreturn]] void refuseTolerance(double tolerancePx);

}  // namespace curvewall
