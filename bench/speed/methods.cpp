// Every method that meets a tolerance, over walls and scenes, against the one that is chosen by itself.

#include "bench/speed/csv.h"
#include "bench/speed/parts.h"
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
        if (rival.request.method == Method::imageBased && rival.request.faceSizePx <= kMostFacePx * 4 / 5)
            add(rival, [](RenderRequest& request) { request.faceSizePx = request.faceSizePx * 5 / 4; });
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

std::optional<RenderStats> statsOf(Renderer& renderer, const RenderRequest& request, const Row& row) {
    try {
        const RenderStats stats = renderer.render(request).stats;
        print(row, "error_px", stats.geometricError.maxPx);
        print(row, "frame_ms", stats.frameMsMedian);
        return stats;
    } catch (const UsageError&) {
        return std::nullopt;  // it cannot draw this display or scene
    }
}

// The one that is chosen is compared by its own time among the rivals, so that noise between two runs of the
// same does not count.
void measureOn(Renderer& renderer, const RenderRequest& base, const Display& display,
               const std::string& name) {
    const auto row = [&](const std::string& settings) { return Row{"methods", name + ": " + settings}; };
    RenderRequest automatic = base;
    automatic.method = Method::automatic;
    const ChoiceStats choice = renderer.render(automatic).stats.choice.value();
    const std::string& chosen = choice.forecasts.front().settings;
    double leastMs = std::numeric_limits<double>::infinity(), chosenMs = leastMs;
    for (const MethodForecast& rival : rivalsOf(base, display)) {
        const std::string settings = settingsOf(rival.request);
        const auto stats = statsOf(renderer, rival.request, row(settings));
        if (!stats) continue;
        print(row(settings), rival.amounts);
        print(row(settings), "forecast_ms", rival.frameMs);
        if (settings == chosen) chosenMs = stats->frameMsMedian;
        if (settings == chosen || stats->geometricError.maxPx <= base.tolerancePx)
            leastMs = std::min(leastMs, stats->frameMsMedian);
    }
    print(row("auto"), "chosen", chosen);
    print(row("auto"), "times_fastest", chosenMs / leastMs);
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
                base.measuresError = true;
                base.pieces = pieces;
                const std::string name = std::filesystem::path(file).stem().string() + "/" + display.name;
                measureOn(renderer, base, display, name + " " + scene->name);
            }
            if (options.firstDisplays) break;
        }
    }
}

}  // namespace curvewall
