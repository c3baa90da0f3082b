// Every method that meets a tolerance, over walls and scenes, against the one that is chosen by itself.

#include "bench/speed/csv.h"
#include "bench/speed/parts.h"
#include "calibration/errors.h"
#include "calibration/readers/wall_reader.h"
#include "renderer/method_choice.h"
#include "renderer/scene/load_scene.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>

namespace curvewall {
namespace {

// Whatever the forecasts say: what somebody might run instead.
std::vector<RenderRequest> rivalsOf(const RenderRequest& base) {
    std::vector<RenderRequest> rivals;
    const auto add = [&](Method method, const auto& change) {
        RenderRequest& rival = rivals.emplace_back(base);
        rival.method = method;
        change(rival);
    };
    add(Method::piecewise, [](RenderRequest&) {});
    for (const int faceSizePx : {0, 4096})
        for (const SourceKind source : {SourceKind::cube, SourceKind::planar})
            add(Method::imageBased, [&](RenderRequest& request) {
                request.faceSizePx = faceSizePx;
                request.source = source;
            });
    return rivals;
}

std::optional<RenderStats> statsOf(Renderer& renderer, const RenderRequest& request, const Row& row) {
    try {
        const RenderStats stats = renderer.render(request).stats;
        print(row, "error_px", stats.geometricError.maxPx);
        print(row, "frame_ms", stats.frameMsMedian);
        return stats;
    } catch (const UsageError& error) {
        return std::nullopt;  // it cannot draw this display or scene
    }
}

void measureOn(Renderer& renderer, const RenderRequest& base, const std::string& name) {
    const auto row = [&](const std::string& settings) { return Row{"methods", name + ": " + settings}; };
    double leastMs = std::numeric_limits<double>::infinity();
    for (const RenderRequest& rival : rivalsOf(base)) {
        const auto stats = statsOf(renderer, rival, row(settingsOf(rival)));
        if (stats && stats->geometricError.maxPx <= base.tolerancePx)
            leastMs = std::min(leastMs, stats->frameMsMedian);
    }
    RenderRequest automatic = base;
    automatic.method = Method::automatic;
    const RenderStats chosen = statsOf(renderer, automatic, row("auto")).value();
    for (const ChoiceStats::Forecast& forecast : chosen.choice->forecasts)
        print(row(forecast.settings), "forecast_ms", forecast.frameMs);
    print(row("auto"), "chosen", chosen.choice->forecasts.front().settings);
    print(row("auto"), "times_fastest", chosen.frameMsMedian / leastMs);
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
            for (const ScenePtr& scene : scenes) {
                RenderRequest base;
                base.wall = wall;
                base.display = display.name;
                base.scene = scene;
                base.camera = scene->defaultCamera;
                base.tolerancePx = options.tolerancePx;
                base.frames = options.frames;
                base.measuresError = true;
                const std::string name = std::filesystem::path(file).stem().string() + "/" + display.name;
                measureOn(renderer, base, name + " " + scene->name);
            }
            if (options.firstDisplays) break;
        }
    }
}

}  // namespace curvewall
