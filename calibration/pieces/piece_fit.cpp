#include "calibration/pieces/piece_fit.h"

#include "calibration/errors.h"
#include "calibration/pieces/radial_fit.h"
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

void certify(const Projection& projection, const std::stop_token& stop, FittedPieces& fitted) {
    const Stopwatch certifying;
    CertifiedPixels pixels = certifyPieces(projection, fitted.mesh, stop);
    fitted.owners = std::make_shared<const std::vector<int32_t>>(std::move(pixels.owners));
    fitted.errorsPx = std::move(pixels.errorsPx);
    fitted.certificate = pixels.certificate;
    fitted.fullyCertifiedAt = std::chrono::steady_clock::now();
    fitted.certifyMs = certifying.ms();
}

// A sparse look tells of most meshes that they will not do.
bool isTooCoarse(const Projection& projection, const PieceMesh& mesh, double tolerancePx,
                 const std::stop_token& stop) {
    constexpr int kFewPixels = 8;  // rows and columns apart
    return certifyPieces(projection, mesh, stop, kFewPixels).certificate.maxPx > tolerancePx;
}

// Pixel centres may find an error between the samples of the fit: only the certificate decides. False where
// that is not a matter of a few more cells: the display then unrolls only as far as `unrolls` looked, or has
// holes.
bool fitQuadGrid(const Projection& projection, glm::ivec2 sizePx, double tolerancePx,
                 const std::stop_token& stop, FittedPieces& fitted) {
    constexpr int kMostRounds = 16;
    QuadGridSearch search(projection, sizePx, tolerancePx, stop);
    std::optional<BalancedGrid> found = search.coarsest();
    for (int round = 0; found && round < kMostRounds; ++round, found = search.finer()) {
        if (isTooCoarse(projection, found->pieces.mesh, tolerancePx, stop)) continue;
        fitted.mesh = std::move(found->pieces.mesh);
        certify(projection, stop, fitted);
        if (fitted.certificate.holes > 0) break;
        if (fitted.certificate.maxPx > tolerancePx) continue;
        fitted.basis = basisOf(std::move(*found));
        return true;
    }
    return false;
}

// False where the display is not round, or the certificate finds what the fit does not see.
bool fitRound(const Projection& projection, glm::ivec2 sizePx, double tolerancePx,
              const std::stop_token& stop, FittedPieces& fitted) {
    constexpr int kMostRounds = 4;
    double goalPx = tolerancePx;
    for (int round = 0; round < kMostRounds; ++round) {
        std::optional<PieceMesh> mesh = fitRadial(projection, sizePx, goalPx, stop);
        if (!mesh) return false;
        fitted.mesh = std::move(*mesh);
        certify(projection, stop, fitted);
        if (fitted.certificate.uncoveredPixels > 0) return false;
        if (fitted.certificate.maxPx <= tolerancePx) {
            fitted.basis = std::make_shared<const FitBasis>();
            return true;
        }
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
    const Stopwatch fitting;
    if (!(unrolls(projection, sizePx) && fitQuadGrid(projection, sizePx, tolerancePx, stop, fitted)) &&
        !fitRound(projection, sizePx, tolerancePx, stop, fitted)) {
        const RayImage rays(projection, sizePx, stop);
        if (std::ranges::none_of(rays.all(), PixelRays::isRay))
            throw UsageError("the display shows nothing: no pixel has a ray");
        FittedCells fit = fitCells(rays, tolerancePx, stop);
        fitted.mesh = std::move(fit.pieces.mesh);
        fitted.basis = basisOf(std::move(fit));
        certify(projection, stop, fitted);
    }
    fitted.fitMs = fitting.ms() - fitted.certifyMs;
    fitted.vertexRays = vertexRaysOf(projection, fitted.mesh);
    return fitted;
}

}  // namespace curvewall
