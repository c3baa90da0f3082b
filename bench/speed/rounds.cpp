#include "bench/speed/rounds.h"

#include <algorithm>
#include <cstddef>

namespace curvewall {

std::vector<Rounds> renderInTurns(Renderer& renderer, std::span<const RenderRequest> requests, int rounds) {
    std::vector<Rounds> all(requests.size());
    for (int round = 0; round < rounds; ++round)
        for (size_t i = 0; i < requests.size(); ++i) all[i].push_back(renderer.render(requests[i]).stats);
    return all;
}

const RenderStats& medianRound(const Rounds& rounds) {
    std::vector<const RenderStats*> sorted;
    for (const RenderStats& stats : rounds) sorted.push_back(&stats);
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::ranges::nth_element(sorted, middle, {}, &RenderStats::frameMsMedian);
    return **middle;
}

double medianRatio(const Rounds& rounds, const Rounds& base) {
    std::vector<double> ratios;
    for (size_t i = 0; i < rounds.size(); ++i)
        ratios.push_back(rounds[i].frameMsMedian / base[i].frameMsMedian);
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::ranges::nth_element(ratios, middle);
    return *middle;
}

}  // namespace curvewall
