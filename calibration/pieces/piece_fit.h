#pragma once
// From a projection and a tolerance to certified pieces.

#include "calibration/pieces/cell_fit.h"
#include "calibration/pieces/certificate.h"
#include "calibration/pieces/fit_stop.h"
#include "calibration/pieces/quad_grid_fit.h"
#include "calibration/wall.h"

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

namespace curvewall {

// What stays as long as the topology of the pieces does. Nothing moves in that of a round display.
struct FitBasis {
    Motion motion;
    std::vector<FacetSample> samples;  // piece by piece; empty for a grid
    glm::ivec2 gridCounts{0};          // columns and rows where the pieces are a grid of quads
    std::optional<CutDisplay> cells;   // otherwise, with the cell of every piece
    std::vector<uint32_t> cellOfPiece;
};

// Never null. Refits whose screen positions stay share it.
using OwnersPtr = std::shared_ptr<const std::vector<int32_t>>;

struct FittedPieces {
    PieceMesh mesh;
    OwnersPtr owners = std::make_shared<const std::vector<int32_t>>();  // see ownership.h
    std::vector<float> errorsPx;  // see certificate.h; empty where that is not of every pixel
    Certificate certificate;      // its maximum is at most the tolerance
    double fitMs = 0;
    double certifyMs = 0;
    std::chrono::steady_clock::time_point fullyCertifiedAt{};  // when every pixel was looked at last

    // For refitPieces (piece_refit.h).
    ProjectionPtr projection;  // where they are those of a display
    std::shared_ptr<const FitBasis> basis;
    std::vector<glm::dvec3> vertexRays;  // what the display shows at the vertices; NaN where nothing
};

inline constexpr int kMostPieces = 200'000;

// Few pieces whose certified maximum is at most `tolerancePx`. Throws UsageError when that would take more
// than kMostPieces, or when no pixel of the display has a ray, and FitStopped soon after a stop is requested.
FittedPieces fitPieces(const Projection& projection, glm::ivec2 sizePx, double tolerancePx,
                       const std::stop_token& stop = {});

// The same for a display of a wall, whose name such errors begin with.
FittedPieces fitPieces(const Display& display, double tolerancePx, const std::stop_token& stop = {});

// The mesh's own pieces are left out.
std::shared_ptr<const FitBasis> basisOf(FittedCells fit);
std::shared_ptr<const FitBasis> basisOf(BalancedGrid grid);

// See FittedPieces::vertexRays.
std::vector<glm::dvec3> vertexRaysOf(const Projection& projection, const PieceMesh& mesh);

// Throws the UsageError of a tolerance that takes too many pieces.
[[noreturn]] void refuseTolerance(double tolerancePx);

}  // namespace curvewall
