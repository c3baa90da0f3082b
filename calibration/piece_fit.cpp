#include "calibration/piece_fit.h"

#include "calibration/errors.h"
#include "calibration/facet_balance.h"
#include "calibration/ownership.h"
#include "calibration/piece_grid.h"
#include "calibration/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace curvewall {
namespace {

// Finds the coarsest grid on the line "columns and rows in the proportion that the bend asks for". `fineness`
// is the place on that line; 1 is where facets on the surface would meet the tolerance.
class GridSearch {
public:
    GridSearch(const Projection& projection, glm::ivec2 sizePx, double tolerancePx)
        : projection_(projection), profile_(projection, sizePx), tolerancePx_(tolerancePx) {}

    // The coarsest grid that meets the tolerance at the samples of the fit.
    BalancedPieces coarsest() {
        double next = 0.7;  // balancing halves the error, so about sqrt(1/2)
        double fails = 0;
        std::optional<BalancedPieces> found;
        for (;;) {
            BalancedPieces tried = at(next);
            const double sampledMaxPx = tried.sampledMaxPx;
            if (sampledMaxPx <= tolerancePx_) {
                fineness_ = next;
                found = std::move(tried);
            } else {
                fails = next;
            }
            if (found && !hasGridBetween(fails, fineness_)) return std::move(*found);
            next =
                guess(next, sampledMaxPx, fails, found ? fineness_ : std::numeric_limits<double>::infinity());
        }
    }

    // The next grid with more cells than the last one returned.
    BalancedPieces finer() {
        fineness_ = nextFiner(fineness_);
        return at(fineness_);
    }

private:
    [[noreturn]] void refuse() const {
        throw UsageError("a tolerance of " + std::to_string(tolerancePx_) + " px needs more than " +
                         std::to_string(kMostPieces) + " pieces");
    }

    BalancedPieces at(double fineness) const {
        const glm::dvec2 cells = cellsAt(fineness);
        if (!(2 * cells.x * cells.y <= kMostPieces)) refuse();
        return balanceFacets(
            projection_, profile_.grid(projection_, static_cast<int>(cells.x), static_cast<int>(cells.y)));
    }

    // Whole numbers, but as many as they may be.
    glm::dvec2 cellsAt(double fineness) const {
        const auto count = [&](double cells) { return std::max(1.0, std::ceil(cells * fineness - 1e-6)); };
        return {count(profile_.columnsFor(tolerancePx_)), count(profile_.rowsFor(tolerancePx_))};
    }

    // Where nothing bends no fineness gives more cells: what is wrong there, cells do not mend.
    double nextFiner(double fineness) const {
        constexpr double kHopeless = 1e12;
        for (double next = fineness * 1.002; next < kHopeless; next *= 1.002)
            if (cellsAt(next) != cellsAt(fineness)) return next;
        refuse();
    }

    // Columns and rows may grow at one fineness: then no grid lies between two that differ in both.
    bool hasGridBetween(double fails, double passes) const {
        const glm::dvec2 gap = cellsAt(passes) - cellsAt(fails);
        return gap.x + gap.y > 1 && passes - fails > 1e-3 * passes;
    }

    // The error falls with the square of the fineness. Where that leads out of the bracket or nowhere new,
    // halve it.
    double guess(double tried, double sampledMaxPx, double fails, double passes) const {
        const double expected = tried * std::sqrt(sampledMaxPx / tolerancePx_);
        if (std::isinf(passes)) return std::max(nextFiner(fails), std::min(expected, 2 * fails));
        const bool isNew = expected > fails && expected < passes && cellsAt(expected) != cellsAt(fails) &&
                           cellsAt(expected) != cellsAt(passes);
        return isNew ? expected : 0.5 * (fails + passes);
    }

    const Projection& projection_;
    BendProfile profile_;
    double tolerancePx_;
    double fineness_ = 0;
};

void certify(const Projection& projection, FittedPieces& fitted) {
    fitted.owners = ownerImage(fitted.mesh);
    fitted.errorsPx = pieceErrorsPx(projection, fitted.mesh, fitted.owners);
    fitted.certificate = certificateOf(fitted.errorsPx, fitted.owners, fitted.mesh.sizePx);
}

}  // namespace

FittedPieces fitPieces(const Projection& projection, glm::ivec2 sizePx, double tolerancePx) {
    if (!(tolerancePx > 0 && std::isfinite(tolerancePx)))
        throw UsageError("a tolerance must be a number of pixels above 0");
    FittedPieces fitted;
    const Stopwatch fitting;
    GridSearch search(projection, sizePx, tolerancePx);
    fitted.mesh = search.coarsest().mesh;
    fitted.fitMs = fitting.ms();

    const Stopwatch certifying;
    certify(projection, fitted);
    // Pixel centres may find an error between the samples of the fit: only the certificate decides.
    while (!(fitted.certificate.maxPx <= tolerancePx)) {
        fitted.mesh = search.finer().mesh;
        certify(projection, fitted);
    }
    fitted.certifyMs = certifying.ms();
    return fitted;
}

}  // namespace curvewall
