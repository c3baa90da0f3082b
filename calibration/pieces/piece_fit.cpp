#include "calibration/pieces/piece_fit.h"

#include "calibration/errors.h"
#include "calibration/pieces/cell_fit.h"
#include "calibration/pieces/ownership.h"
#include "calibration/pieces/quad_grid_fit.h"
#include "calibration/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace curvewall {
namespace {

void certify(const RayImage& rays, FittedPieces& fitted) {
    fitted.owners = ownerImage(fitted.mesh);
    for (size_t i = 0; i < fitted.owners.size(); ++i)
        if (!RayImage::isRay(rays.all()[i])) fitted.owners[i] = kNoPiece;
    fitted.errorsPx = pieceErrorsPx(rays, fitted.mesh, fitted.owners);
    fitted.certificate = certificateOf(fitted.errorsPx, fitted.owners, fitted.mesh.sizePx);
}

// Pixel centres may find an error between the samples of the fit: only the certificate decides.
void fitQuadGrid(const Projection& projection, const RayImage& rays, double tolerancePx,
                 const std::stop_token& stop, FittedPieces& fitted) {
    const Stopwatch fitting;
    QuadGridSearch search(projection, rays.sizePx(), tolerancePx, stop);
    fitted.mesh = search.coarsest().mesh;
    fitted.fitMs += fitting.ms();
    const Stopwatch certifying;
    certify(rays, fitted);
    while (!(fitted.certificate.maxPx <= tolerancePx)) {
        fitted.mesh = search.finer().mesh;
        certify(rays, fitted);
    }
    fitted.certifyMs = certifying.ms();
}

}  // namespace

void refuseTolerance(double tolerancePx) {
    throw UsageError("a tolerance of " + std::to_string(tolerancePx) + " px needs more than " +
                     std::to_string(kMostPieces) + " pieces");
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
    if (unrolls(projection, rays)) {
        fitQuadGrid(projection, rays, tolerancePx, stop, fitted);
        return fitted;
    }
    const Stopwatch fitting;
    fitted.mesh = fitCells(rays, tolerancePx, stop);
    fitted.fitMs += fitting.ms();
    const Stopwatch certifying;
    certify(rays, fitted);
    fitted.certifyMs = certifying.ms();
    return fitted;
}

}  // namespace curvewall
