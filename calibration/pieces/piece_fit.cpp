#include "calibration/pieces/piece_fit.h"

#include "calibration/errors.h"
#include "calibration/pieces/ownership.h"
#include "calibration/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <utility>

namespace curvewall {
namespace {

void certify(const RayImage& rays, FittedPieces& fitted) {
    std::vector<int32_t> owners = ownerImage(fitted.mesh);
    for (size_t i = 0; i < owners.size(); ++i)
        if (!RayImage::isRay(rays.all()[i])) owners[i] = kNoPiece;
    fitted.errorsPx = pieceErrorsPx(rays, fitted.mesh, owners);
    fitted.certificate = certificateOf(fitted.errorsPx, owners, fitted.mesh.sizePx);
    fitted.owners = std::make_shared<const std::vector<int32_t>>(std::move(owners));
    fitted.fullyCertifiedAt = std::chrono::steady_clock::now();
}

// Pixel centres may find an error between the samples of the fit: only the certificate decides. False where
// that is not a matter of a few more cells: the display then unrolls only as far as `unrolls` looked.
bool fitQuadGrid(const Projection& projection, const RayImage& rays, double tolerancePx,
                 const std::stop_token& stop, FittedPieces& fitted) {
    constexpr int kMostRounds = 16;
    const Stopwatch fitting;
    QuadGridSearch search(projection, rays.sizePx(), tolerancePx, stop);
    std::optional<BalancedGrid> found = search.coarsest();
    fitted.fitMs += fitting.ms();
    const Stopwatch certifying;
    for (int round = 0; found && round < kMostRounds; ++round) {
        fitted.mesh = std::move(found->pieces.mesh);
        fitted.basis = basisOf(std::move(*found));
        certify(rays, fitted);
        if (fitted.certificate.maxPx <= tolerancePx) break;
        found = search.finer();
    }
    fitted.certifyMs = certifying.ms();
    return found && fitted.certificate.maxPx <= tolerancePx;
}

}  // namespace

void refuseTolerance(double tolerancePx) {
    std::ostringstream message;
    message << "a tolerance of " << tolerancePx << " px needs more than " << kMostPieces
            << " pieces; ask for a larger one, or smooth what was measured";
    throw UsageError(message.str());
}

std::vector<glm::dvec3> vertexRaysOf(const Projection& projection, const PieceMesh& mesh) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    std::vector<glm::dvec3> rays;
    rays.reserve(mesh.vertices.size());
    for (const PieceVertex& vertex : mesh.vertices)
        rays.push_back(projection.unproject(vertex.s).value_or(glm::dvec3(kNone)));
    return rays;
}

std::shared_ptr<const FitBasis> basisOf(FittedCells fit) {
    return std::make_shared<const FitBasis>(
        FitBasis{std::move(fit.pieces.motion), std::move(fit.pieces.samples), glm::ivec2(0),
                 std::move(fit.cells), std::move(fit.pieces.cellOfPiece)});
}

std::shared_ptr<const FitBasis> basisOf(BalancedGrid grid) {
    return std::make_shared<const FitBasis>(
        FitBasis{std::move(grid.motion), {}, grid.counts, std::nullopt, {}});
}

FittedPieces fitPieces(const Display& display, double tolerancePx, const std::stop_token& stop) {
    try {
        FittedPieces fitted = fitPieces(*display.projection, display.sizePx, tolerancePx, stop);
        fitted.projection = display.projection;
        return fitted;
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
    if (!(unrolls(projection, rays) && fitQuadGrid(projection, rays, tolerancePx, stop, fitted))) {
        const Stopwatch fitting;
        FittedCells fit = fitCells(rays, tolerancePx, stop);
        fitted.mesh = std::move(fit.pieces.mesh);
        fitted.basis = basisOf(std::move(fit));
        fitted.fitMs += fitting.ms();
        const Stopwatch certifying;
        certify(rays, fitted);
        fitted.certifyMs = certifying.ms();
    }
    fitted.vertexRays = vertexRaysOf(projection, fitted.mesh);
    return fitted;
}

}  // namespace curvewall
