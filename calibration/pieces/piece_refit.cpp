#include "calibration/pieces/piece_refit.h"

#include "calibration/errors.h"
#include "calibration/pieces/certificate_lattice.h"
#include "calibration/pieces/facet_following.h"
#include "calibration/pieces/facet_patch.h"
#include "calibration/pieces/ownership.h"
#include "calibration/pieces/quad_grid_fit.h"
#include "calibration/stopwatch.h"

#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

namespace curvewall {
namespace {

// Patches of pieces that fail are balanced with so many rings of pieces around them before cells are cut.
constexpr std::array<int, 2> kRings{0, 1};
constexpr double kMargin = 0.98;  // for the pixels between the samples

// A place in a piece as a blend of its first three vertices.
FacetSample sampleAt(const PieceMesh& mesh, uint32_t piece, glm::dvec2 px) {
    const auto corner = [&](size_t i) {
        return glm::dvec3(mesh.vertices[mesh.pieces[piece].vertices[i]].s, 1);
    };
    const glm::dvec3 blend = glm::inverse(glm::dmat3(corner(0), corner(1), corner(2))) * glm::dvec3(px, 1);
    return {piece, {blend.x, blend.y, blend.z}, px, {}};
}

class Refit {
public:
    Refit(const FittedPieces& before, const Projection& now, double tolerancePx, int every,
          const std::stop_token& stop)
        : before_(before), now_(now), tolerancePx_(tolerancePx), every_(every), stop_(stop) {}

    FittedPieces refit() {
        followDisplay();
        if (isCertified()) return certified();
        if (isGrid()) {
            if (placeGridAnew()) return certified();
        } else if (before_.basis->cells && !lattice_->isEmpty()) {
            for (int rings : kRings)
                if (canBeMended() && mend(rings)) return certified();
            cutCells();
            if (isCertified()) return certified();
        }
        return fitPieces(now_, before_.mesh.sizePx, tolerancePx_, stop_);
    }

private:
    void followDisplay() {
        const Stopwatch fitting;
        fitted_.mesh = before_.mesh;
        fitted_.owners = before_.owners;
        fitted_.basis = before_.basis;
        fitted_.fullyCertifiedAt = before_.fullyCertifiedAt;
        fitted_.vertexRays = vertexRaysOf(now_, fitted_.mesh);
        if (fitted_.basis->motion.unknownCount() > 0)
            follow(fitted_.mesh, fitted_.basis->motion, before_.vertexRays, fitted_.vertexRays);
        fitted_.fitMs += fitting.ms();
    }

    bool isCertified() {
        const Stopwatch certifying;
        lattice_.emplace(now_, fitted_.mesh, *fitted_.owners, every_, hopelessPx(), stop_);
        if (lattice_->outlineHasMoved()) {
            takeOwners();
            lattice_.emplace(now_, fitted_.mesh, *fitted_.owners, every_, hopelessPx(), stop_);
        }
        fitted_.certifyMs += certifying.ms();
        return isCovered() && failing().empty();
    }

    // Where a display shows more than before, there may be no cell with pieces. One that shows nothing any
    // more is none of a refit's business.
    bool isCovered() const { return !lattice_->outlineHasMoved() && !lattice_->isEmpty(); }
    bool canBeMended() const { return isCovered() && turnedOver().empty(); }

    // A grid that is off anywhere is placed anew.
    double hopelessPx() const { return isGrid() ? tolerancePx_ : std::numeric_limits<double>::infinity(); }
    bool isGrid() const { return before_.basis->gridCounts != glm::ivec2(0); }

    void takeOwners() {
        CertifiedPixels pixels = certifyPieces(now_, fitted_.mesh, stop_);
        fitted_.owners = std::make_shared<const std::vector<int32_t>>(std::move(pixels.owners));
    }

    // The pieces that are off by too much somewhere, and those that have turned over on the way, which a
    // sparse lattice need not see.
    std::vector<uint32_t> failing() const {
        std::vector<uint32_t> pieces;
        for (const auto& failure : lattice_->failures(tolerancePx_)) pieces.push_back(failure.piece);
        std::ranges::copy(turnedOver(), std::back_inserter(pieces));
        return pieces;
    }

    std::vector<uint32_t> turnedOver() const {
        std::vector<uint32_t> pieces;
        for (uint32_t k = 0; k < fitted_.mesh.pieces.size() && fitted_.basis == before_.basis; ++k)
            if (!(glm::determinant(fitted_.mesh.pieces[k].screenFromRay) *
                      glm::determinant(before_.mesh.pieces[k].screenFromRay) >
                  0))
                pieces.push_back(k);
        return pieces;
    }

    // As many columns and rows where the bend asks for them now, then more. False where that is not enough.
    bool placeGridAnew() {
        constexpr int kMostRounds = 16;
        const Stopwatch fitting;
        const glm::ivec2 sizePx = before_.mesh.sizePx;
        std::optional<BalancedGrid> grid =
            balancedGrid(now_, BendProfile(now_, sizePx), before_.basis->gridCounts, stop_);
        fitted_.fitMs += fitting.ms();
        if (take(std::move(*grid))) return true;
        QuadGridSearch search(now_, sizePx, tolerancePx_, stop_);
        grid = search.coarsest();
        for (int round = 0; grid && round < kMostRounds; ++round) {
            if (take(std::move(*grid))) return true;
            grid = search.finer();
        }
        return false;
    }

    // Screen positions are others, so the owners are too. True where all is well; a display that does not
    // unroll any more has no such grid.
    bool take(BalancedGrid grid) {
        const Stopwatch fitting;
        fitted_.mesh = std::move(grid.pieces.mesh);
        const auto isExact = [&](const Piece& piece) {
            const auto vertex = [&](size_t i) { return fitted_.mesh.vertices[piece.vertices[i]]; };
            return isExactQuad(vertex(0), vertex(1), vertex(2), vertex(3));
        };
        if (!std::ranges::all_of(fitted_.mesh.pieces, isExact)) return false;
        fitted_.basis = basisOf(std::move(grid));
        fitted_.vertexRays = vertexRaysOf(now_, fitted_.mesh);
        fitted_.owners = std::make_shared<const std::vector<int32_t>>(ownerImage(fitted_.mesh));
        fitted_.fitMs += fitting.ms();
        return isCertified();
    }

    // Balances the pieces that fail and those around them. True where none fails any more.
    bool mend(int rings) {
        const Stopwatch fitting;
        FacetPatch patch(fitted_.mesh, fitted_.basis->motion, failing(), rings);
        patch.balance(samplesOf(patch), kMargin * tolerancePx_, stop_);
        patch.putBack(fitted_.mesh);
        fitted_.fitMs += fitting.ms();
        const Stopwatch certifying;
        lattice_->update(fitted_.mesh, patch.pieces());
        fitted_.certifyMs += certifying.ms();
        return failing().empty();
    }

    // Those of the fit, and where the pieces are off by most.
    std::vector<FacetSample> samplesOf(const FacetPatch& patch) const {
        std::vector<FacetSample> samples;
        const auto add = [&](FacetSample sample) {
            const auto own = std::ranges::lower_bound(patch.pieces(), sample.piece);
            if (own == patch.pieces().end() || *own != sample.piece) return;
            const auto ray = now_.unproject(sample.px);
            if (!ray) return;
            sample.piece = static_cast<uint32_t>(own - patch.pieces().begin());
            sample.ray = *ray;
            samples.push_back(sample);
        };
        for (const FacetSample& sample : fitted_.basis->samples) add(sample);
        for (const auto& failure : lattice_->failures(tolerancePx_))
            add(sampleAt(fitted_.mesh, failure.piece, centreOf(failure.px)));
        std::ranges::stable_sort(samples, {}, &FacetSample::piece);
        return samples;
    }

    void cutCells() {
        const Stopwatch fitting;
        std::vector<uint32_t> cells;
        for (uint32_t piece : failing()) cells.push_back(fitted_.basis->cellOfPiece[piece]);
        std::ranges::sort(cells);
        cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
        FittedCells fit = refitCells(now_, tolerancePx_, *fitted_.basis->cells, cells, stop_);
        fitted_.mesh = std::move(fit.pieces.mesh);
        fitted_.owners = std::make_shared<const std::vector<int32_t>>(std::move(fit.pixels.owners));
        fitted_.basis = basisOf(std::move(fit));
        fitted_.vertexRays = vertexRaysOf(now_, fitted_.mesh);
        fitted_.fitMs += fitting.ms();
    }

    FittedPieces certified() {
        fitted_.certificate = lattice_->certificate();
        if (every_ == 1) {
            fitted_.errorsPx = std::move(*lattice_).takeErrorsPx();
            fitted_.fullyCertifiedAt = std::chrono::steady_clock::now();
        }
        return std::move(fitted_);
    }

    const FittedPieces& before_;
    const Projection& now_;
    const double tolerancePx_;
    const int every_;
    const std::stop_token& stop_;
    FittedPieces fitted_;
    std::optional<CertificateLattice> lattice_;
};

}  // namespace

FittedPieces refitPieces(const FittedPieces& before, const Projection& now, double tolerancePx, int every,
                         const std::stop_token& stop) {
    return Refit(before, now, tolerancePx, every, stop).refit();
}

FittedPieces refitPieces(const FittedPieces& before, const Display& now, double tolerancePx, int every,
                         const std::stop_token& stop) {
    const bool isTheSame = before.projection == now.projection && before.certificate.maxPx <= tolerancePx;
    if (isTheSame && before.certificate.every <= every) return before;
    try {
        FittedPieces fitted = refitPieces(before, *now.projection, tolerancePx, every, stop);
        fitted.projection = now.projection;
        return fitted;
    } catch (const UsageError& error) {
        throw UsageError("display \"" + now.name + "\": " + error.what());
    }
}

}  // namespace curvewall
