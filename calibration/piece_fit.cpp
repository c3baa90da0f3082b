#include "calibration/piece_fit.h"

#include "calibration/errors.h"
#include "calibration/facet_balance.h"
#include "calibration/ownership.h"
#include "calibration/piece_grid.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

namespace curvewall {
namespace {

using Clock = std::chrono::steady_clock;

double msSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Finds the coarsest grid on the line "columns and rows in the proportion that the bend asks for".
class GridSearch {
public:
    GridSearch(const Projection& projection, glm::ivec2 sizePx, double tolerancePx)
        : projection_(projection), profile_(projection, sizePx), tolerancePx_(tolerancePx) {}

    // Balanced pieces of the grid at `fineness`; 1 is where facets on the surface would meet the tolerance.
    BalancedPieces at(double fineness) const {
        const glm::ivec2 cells = cellsAt(fineness);
        if (2.0 * cells.x * cells.y > kMostPieces)
            throw UsageError("a tolerance of " + std::to_string(tolerancePx_) + " px needs more than " +
                             std::to_string(kMostPieces) + " pieces");
        return balanceFacets(projection_, profile_.grid(projection_, cells.x, cells.y));
    }

    bool meets(const BalancedPieces& pieces) const { return pieces.sampledMaxPx <= tolerancePx_; }

    // The smallest fineness that meets the tolerance at the samples.
    double coarsest() const {
        double fails = 0, passes = 0.7;  // balancing halves the error, so about sqrt(1/2)
        while (!meets(at(passes))) {
            fails = passes;
            passes *= 1.2;
        }
        // Columns and rows may grow at one fineness: then no grid lies between two that differ in both.
        const auto gap = [&] { return cellsAt(passes) - cellsAt(fails); };
        while (gap().x + gap().y > 1 && passes - fails > 1e-3 * passes) {
            const double middle = 0.5 * (fails + passes);
            (meets(at(middle)) ? passes : fails) = middle;
        }
        return passes;
    }

    // The fineness of the next grid with more cells.
    double finer(double fineness) const {
        const glm::ivec2 cells = cellsAt(fineness);
        double next = fineness;
        while (cellsAt(next) == cells) next *= 1.002;
        return next;
    }

private:
    glm::ivec2 cellsAt(double fineness) const {
        const auto count = [&](double cells) {
            return std::max(1, static_cast<int>(std::ceil(cells * fineness - 1e-6)));
        };
        return {count(profile_.columnsFor(tolerancePx_)), count(profile_.rowsFor(tolerancePx_))};
    }
    const Projection& projection_;
    BendProfile profile_;
    double tolerancePx_;
};

}  // namespace

FittedPieces fitPieces(const Projection& projection, glm::ivec2 sizePx, double tolerancePx) {
    FittedPieces fitted;
    const GridSearch search(projection, sizePx, tolerancePx);
    auto start = Clock::now();
    double fineness = search.coarsest();
    fitted.mesh = search.at(fineness).mesh;
    fitted.fitMs = msSince(start);

    // Pixel centres may find an error between the samples of the fit: only the certificate decides.
    start = Clock::now();
    for (;; fineness = search.finer(fineness), fitted.mesh = search.at(fineness).mesh) {
        fitted.owners = ownerImage(fitted.mesh);
        fitted.errorsPx = pieceErrorsPx(projection, fitted.mesh, fitted.owners);
        fitted.certificate = certificateOf(fitted.errorsPx, fitted.owners, sizePx);
        if (fitted.certificate.maxPx <= tolerancePx) break;
    }
    fitted.certifyMs = msSince(start);
    return fitted;
}

}  // namespace curvewall
