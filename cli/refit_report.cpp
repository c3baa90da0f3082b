#include "cli/refit_report.h"

#include "calibration/pieces/piece_refit.h"
#include "calibration/stopwatch.h"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <utility>

namespace curvewall {

FollowedPieces followPieces(const Display& own, const Display& now, double tolerancePx) {
    FollowedPieces followed;
    const Stopwatch fitting;
    const FittedPieces before = fitPieces(own, tolerancePx);
    followed.fitMs = fitting.ms();
    followed.piecesBefore = before.mesh.pieces.size();
    const Stopwatch refitting;
    const FittedPieces atOnce = refitPieces(before, now, tolerancePx, kSparseRows);
    followed.refitMs = refitting.ms();
    followed.piecesAtOnce = atOnce.mesh.pieces.size();
    followed.atOnce = atOnce.certificate;
    const Stopwatch completing;
    followed.pieces = refitPieces(atOnce, now, tolerancePx, 1);
    followed.fullMs = completing.ms();
    followed.pieces.fitMs += atOnce.fitMs;
    return followed;
}

nlohmann::json toJson(const FollowedPieces& followed) {
    const Certificate& c = followed.atOnce;
    return {{"own_eye", {{"pieces", followed.piecesBefore}, {"fit_ms", followed.fitMs}}},
            {"refit_ms", followed.refitMs},
            {"pieces", followed.piecesAtOnce},
            {"certificate",
             {{"every", c.every},
              {"max", c.maxPx},
              {"p99", c.p99Px},
              {"mean", c.meanPx},
              {"max_at", {c.maxAt.x, c.maxAt.y}}}},
            {"full_certificate_ms", followed.fullMs}};
}

void printReport(const FollowedPieces& followed) {
    const Certificate& c = followed.atOnce;
    fmt::print("  {} pieces fitted at the wall's own eye in {:.0f} ms\n", followed.piecesBefore,
               followed.fitMs);
    fmt::print("  refitted to {} pieces in {:.1f} ms; over every {}th row and column {:.4f} px at most\n",
               followed.piecesAtOnce, followed.refitMs, c.every, c.maxPx);
    fmt::print("  certified at every pixel {:.0f} ms later\n", followed.fullMs);
}

}  // namespace curvewall
