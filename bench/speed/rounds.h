#pragma once
// Measures that may be compared: what slows the machine down slows down all of them.

#include "renderer/render.h"

#include <span>
#include <vector>

namespace curvewall {

using Rounds = std::vector<RenderStats>;  // of one request

// Renders the requests in turns: A, B, C, A, B, C ...
std::vector<Rounds> renderInTurns(Renderer& renderer, std::span<const RenderRequest> requests, int rounds);

// The round with the median time of a frame.
const RenderStats& medianRound(const Rounds& rounds);

// How many times longer a frame takes, the median over the rounds.
double medianRatio(const Rounds& rounds, const Rounds& base);

}  // namespace curvewall
