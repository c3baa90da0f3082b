// Every method that meets a tolerance, over walls and scenes, against the one that is chosen by itself.

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

// What is forecast, and what somebody might run instead.
std::vector<MethodForecast> rivalsOf(const RenderRequest& base, const Display& display) {
    std::vector<MethodForecast> rivals = forecastMethods(base, display).forecasts;
    const auto add = [&](MethodForecast rival, const auto& change) {
        change(rival.request);
        rivals.push_back(std::move(rival));
    };
    for (size_t i = 0, count = rivals.size(); i < count; ++i) {
        const MethodForecast rival = rivals[i];
        if (rival.request.method == Method::vertexWarp && rival.request.tessellationPx > 0)
            for (const double longer : {0.7, 1.4})
                add(rival, [&](RenderRequest& request) {
                    request.tessellationPx = std::clamp(request.tessellationPx * longer, kLeastTessellationPx,
                                                        kMostTessellationPx);
                });
    }
    return rivals;
}

void print(const Row& row, const FrameAmounts& amounts) {
    print(row, "seen_triangles", amounts.seenTriangles);
    print(row, "drawn_triangles", amounts.drawnTriangles);
    print(row, "fragments", amounts.fragments);
    print(row, "resampled_px", amounts.resampledPx);
}

// Those of the rivals that can draw the display and the scene within the tolerance.
std::vector<MethodForecast> ableOnes(Renderer& renderer, const std::vector<MethodForecast>& rivals,
                                     const std::string& name) {
    std::vector<MethodForecast> able;
    for (const MethodForecast& rival : rivals) {
        RenderRequest once = rival.request;
        once.frames = 1;
        once.measuresError = true;
        const Row row{"methods", name + ": " + settingsOf(rival.request)};
        try {
            const double errorPx = renderer.render(once).stats.geometricError.maxPx;
            print(row, "error_px", errorPx);
            if (errorPx <= rival.request.tolerancePx) able.push_back(rival);
        } catch (const UsageError& error) {
            print(row, "refused", error.what());
        }
    }
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
                RenderRequest base;
                base.wall = wall;
                base.display = display.name;
                base.scene = scene;
                base.camera = scene->defaultCamera;
                base.tolerancePx = options.tolerancePx;
                base.frames = options.frames;
                base.pieces = pieces;
                const std::string name = std::filesystem::path(file).stem().string() + "/" + display.name;
                measureOn(renderer, base, display, options, name + " " + scene->name);
            }
            if (options.firstDisplays) break;
        }
    }
}

}  // namespace curvewall
