#include "renderer/methods/automatic_method.h"

#include "calibration/errors.h"
#include "calibration/stopwatch.h"
#include "renderer/names.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

namespace curvewall {
namespace {

// Forecasts are off by up to this factor (docs/auto.md): what is closer is tried.
constexpr double kDoubt = 2.5;
constexpr int kTrialFrames = 3;
// Those that a trial sees this close are tried again in turns, so that no disturbance of a moment decides.
constexpr double kClose = 2;
constexpr int kMoreTrials = 2;

// Some frames of the method. False, with the reason among those ruled out, where it cannot draw the scene or
// misses the tolerance after all.
bool passesTrial(MethodForecast& forecast, std::vector<std::string>& ruledOut,
                 const AutomaticMethod::RenderSettled& settled) {
    RenderRequest trial = forecast.request;
    trial.frames = kTrialFrames;
    trial.timesStages = false;
    trial.measuresError = true;
    try {
        const RenderStats stats = settled(trial).stats;
        forecast.trialMs = stats.frameMsMedian;
        forecast.errorPx = stats.geometricError.maxPx;
        if (trial.method == Method::piecewise || forecast.errorPx <= trial.tolerancePx) return true;
        ruledOut.push_back(
            fmt::format("{}: off by up to {:.3g} px in a trial", settingsOf(trial), forecast.errorPx));
    } catch (const UsageError& error) {
        ruledOut.push_back(fmt::format("{}: {}", settingsOf(trial), error.what()));
    }
    return false;
}

void tryAgainInTurns(std::vector<MethodForecast>& forecasts, const AutomaticMethod::RenderSettled& settled) {
    double leastMs = std::numeric_limits<double>::infinity();
    for (const MethodForecast& forecast : forecasts)
        leastMs = std::min(leastMs, forecast.trialMs.value_or(leastMs));
    std::vector<MethodForecast*> close;
    for (MethodForecast& forecast : forecasts)
        if (forecast.trialMs && *forecast.trialMs <= kClose * leastMs) close.push_back(&forecast);
    if (close.size() < 2) return;
    for (int turn = 0; turn < kMoreTrials; ++turn)
        for (MethodForecast* forecast : close) {
            RenderRequest trial = forecast->request;
            trial.frames = kTrialFrames;
            trial.timesStages = trial.measuresError = false;
            forecast->trialMs = std::min(*forecast->trialMs, settled(trial).stats.frameMsMedian);
        }
}

// Afterwards the fastest comes first: those that were tried, then those whose forecast leaves no doubt that
// they are slower. Piecewise, which is certified and draws everything, goes without a trial where it is
// alone.
void tryThoseInDoubt(MethodChoice& choice, const AutomaticMethod::RenderSettled& settled) {
    std::vector<MethodForecast> kept;
    double mostMs = std::numeric_limits<double>::infinity();
    for (size_t i = 0; i < choice.forecasts.size(); ++i) {
        MethodForecast& forecast = choice.forecasts[i];
        const bool doubted = forecast.frameMs <= mostMs;
        const bool isAlone = kept.empty() && (i + 1 == choice.forecasts.size() ||
                                              choice.forecasts[i + 1].frameMs > kDoubt * forecast.frameMs);
        const bool needsTrial = doubted && !(isAlone && forecast.request.method == Method::piecewise);
        if (needsTrial && !passesTrial(forecast, choice.ruledOut, settled)) continue;
        if (kept.empty()) mostMs = kDoubt * forecast.frameMs;
        kept.push_back(std::move(forecast));
    }
    choice.forecasts = std::move(kept);
    tryAgainInTurns(choice.forecasts, settled);
    std::ranges::stable_sort(choice.forecasts, [](const MethodForecast& a, const MethodForecast& b) {
        return a.trialMs && (!b.trialMs || *a.trialMs < *b.trialMs);
    });
}

// Those that forecasts turn.
void turnKnobs(RenderRequest& request, const RenderRequest& chosen) {
    request.method = chosen.method;
    request.source = chosen.source;
    request.faceSizePx = chosen.faceSizePx;
    request.bounds = chosen.bounds;
    request.tessellationPx = chosen.tessellationPx;
}

ChoiceStats statsOf(const MethodChoice& choice) {
    ChoiceStats stats;
    for (const MethodForecast& forecast : choice.forecasts)
        stats.forecasts.push_back(
            {settingsOf(forecast.request), forecast.errorPx, forecast.frameMs, forecast.trialMs});
    stats.ruledOut = choice.ruledOut;
    const MethodForecast& chosen = choice.forecasts.front();
    stats.why = fmt::format("{} meets {} px and ", settingsOf(chosen.request), chosen.request.tolerancePx);
    if (choice.forecasts.size() == 1)
        stats.why += "is the only one that does";
    else if (chosen.trialMs)
        stats.why += fmt::format("took {:.1f} ms a frame in trials", *chosen.trialMs);
    else
        stats.why +=
            fmt::format("should take {:.1f} times less than {}", choice.forecasts[1].frameMs / chosen.frameMs,
                        settingsOf(choice.forecasts[1].request));
    return stats;
}

}  // namespace

RenderResult AutomaticMethod::render(const RenderRequest& request, const Display& display,
                                     const RenderSettled& settled) {
    const Stopwatch choosing;
    const auto choice =
        choices_.get({request.wall, &display, request.scene, request.tolerancePx, request.samples,
                      request.engine, request.filter, request.style, request.output},
                     [&] {
                         MethodChoice made = forecastMethods(request, display);
                         tryThoseInDoubt(made, settled);
                         return std::make_shared<const MethodChoice>(std::move(made));
                     });
    const double choosingMs = choosing.ms();
    RenderRequest now = request;
    turnKnobs(now, choice->forecasts.front().request);
    RenderResult result = settled(now);
    result.stats.prepareMs += choosingMs;
    result.stats.choice = statsOf(*choice);
    return result;
}

}  // namespace curvewall
