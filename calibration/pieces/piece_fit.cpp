#include "calibration/pieces/piece_fit.h"

#include "calibration/errors.h"
#include "calibration/pieces/cell_fit.h"
#include "calibration/pieces/ownership.h"
#include "calibration/pieces/quad_grid_fit.h"
#include "calibration/pieces/radial_fit.h"
#include "calibration/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

namespace curvewall {
namespace {

void certify(const RayImage& rays, FittedPieces& fitted) {
    fitted.owners = ownerImage(fitted.mesh);
    for (size_t i = 0; i < fitted.owners.size(); ++i)
        if (!RayImage::isRay(rays.all()[i])) fitted.owners[i] = kNoPiece;
    fitted.errorsPx = pieceErrorsPx(rays, fitted.mesh, fitted.owners);
    fitted.certificate = certificateOf(fitted.errorsPx, fitted.owners, fitted.mesh.sizePx);
}

// Pixel centres may find an error between the samples of the fit: only the certificate decides. False where
// that is not a matter of a few more cells: the display then unrolls only as far as `unrolls` looked.
bool fitQuadGrid(const Projection& projection, const RayImage& rays, double tolerancePx,
                 const std::stop_token& stop, FittedPieces& fitted) {
    constexpr int kMostRounds = 16;
    const Stopwatch fitting;
    QuadGridSearch search(projection, rays.sizePx(), tolerancePx, stop);
    std::optional<BalancedPieces> found = search.coarsest();
    fitted.fitMs += fitting.ms();
    const Stopwatch certifying;
    for (int round = 0; found && round < kMostRounds; ++round) {
        fitted.mesh = std::move(found->mesh);
        certify(rays, fitted);
        if (fitted.certificate.maxPx <= tolerancePx) break;
        found = search.finer();
    }
    fitted.certifyMs = certifying.ms();
    return found && fitted.certificate.maxPx <= tolerancePx;
}

// False where the display is not round, or the certificate finds what the fit does not see.
bool fitRound(const Projection& projection, const RayImage& rays, double tolerancePx, const std::stop_token& stop,
              FittedPieces& fitted) {
    constexpr int kMostRounds = 4;
    double goalPx = tolerancePx;
    for (int round = 0; round < kMostRounds; ++round) {
        const Stopwatch fitting;
        std::optional<PieceMesh> mesh = fitRadial(projection, rays.sizePx(), goalPx, stop);
        fitted.fitMs += fitting.ms();
        if (!mesh) return false;
        fitted.mesh = std::move(*mesh);
        const Stopwatch certifying;
        certify(rays, fitted);
        fitted.certifyMs += certifying.ms();
        if (fitted.certificate.uncoveredPixels > 0) return false;
        if (fitted.certificate.maxPx <= tolerancePx) return true;
        goalPx *= 0.995 * tolerancePx / fitted.certificate.maxPx;
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
    const Stopwatch sampling;
    const RayImage rays(projection, sizePx, stop);
    if (std::ranges::none_of(rays.all(), RayImage::isRay))
        throw UsageError("the display shows nothing: no pixel has a ray");
    fitted.fitMs = sampling.ms();
    if (unrolls(projection, rays) && fitQuadGrid(projection, rays, tolerancePx, stop, fitted)) return fitted;
    if (fitRound(projection, rays, tolerancePx, stop, fitted)) return fitted;
    const Stopwatch fitting;
    fitted.mesh = fitCells(rays, tolerancePx, stop);
    fitted.fitMs += fitting.ms();
    const Stopwatch certifying;
    certify(rays, fitted);
    fitted.certifyMs = certifying.ms();
    return fitted;
}

}  // namespace curvewall
