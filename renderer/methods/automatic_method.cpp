#include "renderer/methods/automatic_method.h"

#include "calibration/errors.h"
#include "calibration/stopwatch.h"
#include "renderer/names.h"

#include <fmt/core.h>

#include <algorithm>

namespace curvewall {
namespace {

// Forecasts are off by up to this factor (docs/auto.md): what is closer is tried.
constexpr double kDoubt = 2;
constexpr int kTrialFrames = 3;

// The fastest comes first. One that cannot draw this scene is ruled out.
void tryThoseInDoubt(MethodChoice& choice, const AutomaticMethod::RenderSettled& settled) {
    const double most = kDoubt * choice.forecasts.front().frameMs;
    const auto inDoubt = [&](const MethodForecast& forecast) { return forecast.frameMs <= most; };
    if (std::ranges::count_if(choice.forecasts, inDoubt) < 2) return;
    std::vector<MethodForecast> tried;
    for (MethodForecast& forecast : choice.forecasts) {
        if (inDoubt(forecast)) {
            RenderRequest trial = forecast.request;
            trial.frames = kTrialFrames;
            trial.timesStages = trial.measuresError = false;
            try {
                forecast.trialMs = settled(trial).stats.frameMsMedian;
            } catch (const UsageError& error) {
                choice.ruledOut.push_back(fmt::format("{}: {}", nameOf(trial.method), error.what()));
                continue;
            }
        }
        tried.push_back(std::move(forecast));
    }
    choice.forecasts = std::move(tried);
    // Those that were not tried keep their order, behind.
    std::ranges::stable_sort(choice.forecasts, [](const MethodForecast& a, const MethodForecast& b) {
        return a.trialMs && (!b.trialMs || *a.trialMs < *b.trialMs);
    });
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
    const auto choice = choices_.get({request.wall, &display, request.scene, request.tolerancePx,
                                      request.samples, request.style, request.output},
                                     [&] {
                                         MethodChoice made = forecastMethods(request, display);
                                         tryThoseInDoubt(made, settled);
                                         return std::make_shared<const MethodChoice>(std::move(made));
                                     });
    const double choosingMs = choosing.ms();
    RenderRequest now = choice->forecasts.front().request;
    now.camera = request.camera;
    now.pieces = request.pieces;
    now.anisotropy = request.anisotropy;
    now.linearOutput = request.linearOutput;
    now.timesStages = request.timesStages;
    now.measuresError = request.measuresError;
    now.frames = request.frames;
    RenderResult result = settled(now);
    result.stats.prepareMs += choosingMs;
    result.stats.choice = statsOf(*choice);
    return result;
}

}  // namespace curvewall
