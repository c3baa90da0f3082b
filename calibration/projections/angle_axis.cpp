#include "calibration/projections/angle_axis.h"

#include <cmath>
#include <numbers>

namespace curvewall {

std::vector<double> AngleAxis::positionsOf(double angleRad) const {
    constexpr double kTurnRad = 2 * std::numbers::pi, kRoundingTurns = 1e-12;
    const double turns = arcRad / kTurnRad, place = angleRad / arcRad + 0.5;
    if (turns < 1 - kRoundingTurns) return {place * lengthPx};
    if (turns <= 1 + kRoundingTurns) {
        // Rounding may leave the last position at the full length, which is the first.
        const double px = (place - std::floor(place)) * lengthPx;
        return {px >= lengthPx ? 0.0 : px};
    }
    std::vector<double> positions;
    const double first = std::ceil(-place * turns - kRoundingTurns);
    const double last = std::floor((1 - place) * turns + kRoundingTurns);
    for (double turn = first; turn <= last; ++turn) positions.push_back((place + turn / turns) * lengthPx);
    return positions;
}

}  // namespace curvewall
