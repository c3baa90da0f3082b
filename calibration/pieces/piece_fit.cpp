#include "calibration/pieces/piece_fit.h"

#include "calibration/errors.h"
#include "calibration/pieces/cell_fit.h"
#include "calibration/pieces/quad_grid_fit.h"
#include "calibration/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

namespace curvewall {
namespace {

void certify(const Projection& projection, const std::stop_token& stop, FittedPieces& fitted) {
    const Stopwatch certifying;
    CertifiedPixels pixels = certifyPieces(projection, fitted.mesh, stop);
    fitted.owners = std::move(pixels.owners);
    fitted.errorsPx = std::move(pixels.errorsPx);
    fitted.certificate = pixels.certificate;
    fitted.certifyMs += certifying.ms();
}

// Pixel centres may find an error between the samples of the fit: only the certificate decides. False where
// that is not a matter of a few more cells: the display then unrolls only as far as `unrolls` looked, or has
// holes.
bool fitQuadGrid(const Projection& projection, glm::ivec2 sizePx, double tolerancePx,
                 const std::stop_token& stop, FittedPieces& fitted) {
    constexpr int kMostRounds = 16;
    constexpr int kFewPixels = 8;  // rows and columns apart: they tell of most grids that they will not do
    const Stopwatch searching;
    QuadGridSearch search(projection, sizePx, tolerancePx, stop);
    const auto isTooCoarse = [&](const PieceMesh& mesh) {
        return certifyPieces(projection, mesh, stop, kFewPixels).certificate.maxPx > tolerancePx;
    };
    std::optional<BalancedPieces> found = search.coarsest();
    for (int round = 0; found && round < kMostRounds; ++round, found = search.finer()) {
        if (isTooCoarse(found->mesh)) continue;
        fitted.mesh = std::move(found->mesh);
        certify(projection, stop, fitted);
        if (fitted.certificate.holes > 0) break;
        if (fitted.certificate.maxPx > tolerancePx) continue;
        fitted.fitMs = searching.ms() - fitted.certifyMs;
        return true;
    }
    return false;
}

}  // namespace

void refuseTolerance(double tolerancePx) {
    std::ostringstream message;
    message << "a tolerance of " << tolerancePx << " px needs more than " << kMostPieces
            << " pieces; ask for a larger one, or smooth what was measured";
    throw UsageError(message.str());
}

FittedPieces fitPieces(const Display& display, double tolerancePx, const std::stop_token& stop) {
    try {
        return fitPieces(*display.projection, display.sizePx, tolerancePx, stop);
    } catch (const UsageError& error) {
        throw UsageError("display \"" + display.name + "\": " + error.what());
    }
}

FittedPieces fitPieces(const Projection& projection, glm::ivec2 sizePx, double tolerancePx,
                       const std::stop_token& stop) {
    if (!(tolerancePx > 0 && std::isfinite(tolerancePx)))
        throw UsageError("a tolerance must be a number of pixels above 0");
    FittedPieces fitted;
    const Stopwatch fitting;
    if (unrolls(projection, sizePx) && fitQuadGrid(projection, sizePx, tolerancePx, stop, fitted))
        return fitted;
    CertifiedCells cells = fitCells(projection, sizePx, tolerancePx, stop);
    const double fitMs = fitting.ms() - cells.certifyMs;
    return {std::move(cells.mesh),
            std::move(cells.pixels.owners),
            std::move(cells.pixels.errorsPx),
            cells.pixels.certificate,
            fitMs,
            cells.certifyMs};
}

}  // namespace curvewall
