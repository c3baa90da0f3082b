// Every method that meets a tolerance, over walls and scenes, against the one that is chosen by itself.

#include "bench/request.h"
#include "bench/speed/csv.h"
#include "bench/speed/parts.h"
#include "bench/speed/rounds.h"
#include "calibration/errors.h"
#include "calibration/pieces/piece_fit.h"
#include "calibration/readers/wall_reader.h"
#include "renderer/method_choice.h"
#include "renderer/request_limits.h"
#include "renderer/scene/load_scene.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>

namespace curvewall {
namespace {

// What is forecast; and vertex-warp with shorter edges, where those that are forecast miss the tolerance.
// Longer ones may meet it in one frame, which tells nothing of the next.
std::vector<MethodForecast> rivalsOf(const RenderRequest& base, const Display& display) {
    std::vector<MethodForecast> rivals = forecastMethods(base, display).forecasts;
    const auto warp = std::ranges::find_if(rivals, [](const MethodForecast& rival) {
        return rival.request.method == Method::vertexWarp && rival.request.tessellationPx > 0;
    });
    if (warp != rivals.end()) {
        MethodForecast shorter = *warp;
        shorter.request.tessellationPx = std::max(0.7 * warp->request.tessellationPx, kLeastTessellationPx);
        rivals.push_back(std::move(shorter));
    }
    return rivals;
}

void print(const Row& row, const FrameAmounts& amounts) {
    print(row, "seen_triangles", amounts.seenTriangles);
    print(row, "drawn_triangles", amounts.drawnTriangles);
    print(row, "fragments", amounts.fragments);
    print(row, "resampled_px", amounts.resampledPx);
}

// Those of the rivals that can draw the display and the scene within the tolerance, but for those that are
// out of the question: their first frame takes many times as long as the fastest.
std::vector<MethodForecast> ableOnes(Renderer& renderer, std::vector<MethodForecast> rivals,
                                     const std::string& name) {
    constexpr double kOutOfTheQuestion = 4;
    std::vector<MethodForecast> able;
    double leastMs = std::numeric_limits<double>::infinity();
    for (MethodForecast& rival : rivals) {
        RenderRequest once = rival.request;
        once.frames = 2;  // of one frame alone, drivers compile within it
        once.measuresError = true;
        const Row row{"methods", name + ": " + settingsOf(rival.request)};
        try {
            const RenderStats stats = renderer.render(once).stats;
            print(row, "error_px", stats.geometricError.maxPx);
            print(row, "first_ms", stats.frameMsMedian);
            if (stats.geometricError.maxPx > rival.request.tolerancePx) continue;
            rival.trialMs = stats.frameMsMedian;
            leastMs = std::min(leastMs, stats.frameMsMedian);
            able.push_back(std::move(rival));
        } catch (const UsageError& error) {
            print(row, "refused", error.what());
        }
    }
    std::erase_if(able, [&](const auto& rival) { return *rival.trialMs > kOutOfTheQuestion * leastMs; });
    return able;
}

void measureOn(Renderer& renderer, const RenderRequest& base, const Display& display,
               const SpeedOptions& options, const std::string& name) {
    RenderRequest automatic = base;
    automatic.method = Method::automatic;
    const std::string chosen = renderer.render(automatic).stats.choice.value().forecasts.front().settings;

    const std::vector<MethodForecast> able = ableOnes(renderer, rivalsOf(base, display), name);
    std::vector<RenderRequest> requests;
    for (const MethodForecast& rival : able) requests.push_back(rival.request);
    const std::vector<Rounds> rounds = renderInTurns(renderer, requests, options.rounds);
    const Rounds* ofChosen = nullptr;
    for (size_t i = 0; i < able.size(); ++i) {
        const std::string settings = settingsOf(able[i].request);
        const Row row{"methods", name + ": " + settings};
        print(row, "frame_ms", medianRound(rounds[i]).frameMsMedian);
        print(row, "forecast_ms", able[i].frameMs);
        print(row, able[i].amounts);
        print(row, "pairs", static_cast<double>(medianRound(rounds[i]).pairs));
        if (settings == chosen) ofChosen = &rounds[i];
    }
    const Row row{"methods", name + ": auto"};
    print(row, "chosen", chosen);
    double timesFastest = 1;
    for (const Rounds& rival : rounds)
        if (ofChosen != nullptr) timesFastest = std::max(timesFastest, medianRatio(*ofChosen, rival));
    if (ofChosen != nullptr) print(row, "times_fastest", timesFastest);
}

}  // namespace

void measureMethods(const SpeedOptions& options) {
    std::vector<ScenePtr> scenes;
    for (const std::string& scene : options.scenes)
        scenes.push_back(std::make_shared<const Scene>(loadScene(scene)));
    for (const std::string& file : options.walls) {
        const auto wall = std::make_shared<const Wall>(readWall(file));
        for (const Display& display : wall->displays) {
            Renderer renderer;
            const auto pieces = std::make_shared<const FittedPieces>(fitPieces(display, options.tolerancePx));
            for (const ScenePtr& scene : scenes) {
                RenderRequest base = requestFor(wall, scene, options.frames);
                base.display = display.name;
                base.tolerancePx = options.tolerancePx;
                base.pieces = pieces;
                const std::string name = std::filesystem::path(file).stem().string() + "/" + display.name;
                measureOn(renderer, base, display, options, name + " " + scene->name);
            }
            if (options.firstDisplays) break;
        }
    }
}

}  // namespace curvewall
