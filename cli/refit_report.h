#pragma once
// curvewall inspect --refit: pieces of one eye follow to another.

#include "calibration/pieces/piece_fit.h"

#include <nlohmann/json_fwd.hpp>

namespace curvewall {

struct FollowedPieces {
    double fitMs = 0;  // at the wall's own eye
    size_t piecesBefore = 0;
    double refitMs = 0;  // with the sparse certificate
    size_t piecesAtOnce = 0;
    Certificate atOnce;
    double fullMs = 0;    // what came after
    FittedPieces pieces;  // certified at every pixel
};

// Fits the display at its own eye, refits the pieces to the one of `now` and completes their certificate.
FollowedPieces followPieces(const Display& own, const Display& now, double tolerancePx);

nlohmann::json toJson(const FollowedPieces& followed);
void printReport(const FollowedPieces& followed);

}  // namespace curvewall
