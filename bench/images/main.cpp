// The image-based method's choices side by side, as CSV: how faces are drawn, where they are looked up, how
// they are filtered. Run it on an otherwise idle machine.

#include "bench/request.h"
#include "bench/speed/rounds.h"
#include "calibration/errors.h"
#include "calibration/readers/wall_reader.h"
#include "renderer/image_compare.h"
#include "renderer/names.h"
#include "renderer/scene/load_scene.h"

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include <exception>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

namespace curvewall {
namespace {

struct Options {
    std::vector<std::string> walls;
    std::string part = "filters", scene = "city", display;
    int frames = 6, rounds = 3;
};

// What the exact projection shows at pixel centres, and over whole pixels.
struct Truth {
    Frame centres, pixels;
};

Truth truthOf(Renderer& renderer, RenderRequest request) {
    constexpr int kManyRays = 16;
    request.method = Method::reference;
    Truth truth;
    truth.centres = renderer.render(request).frame;
    request.samples = kManyRays;
    truth.pixels = renderer.render(request).frame;
    return truth;
}

// One pass for all faces against one for each.
std::vector<RenderRequest> passes(const RenderRequest& base) {
    std::vector<RenderRequest> requests;
    for (const int faceSizePx : {16, 512, 0}) {
        for (const FacePass pass : {FacePass::separate, FacePass::layered}) {
            RenderRequest& request = requests.emplace_back(base);
            request.faceSizePx = faceSizePx;
            request.facePass = pass;
        }
    }
    return requests;
}

std::vector<RenderRequest> lookups(const RenderRequest& base) {
    std::vector<RenderRequest> requests{base};
    for (const int stepPx : {4, 8, 16, 32, 64}) {
        RenderRequest& request = requests.emplace_back(base);
        request.lookup = SourceLookup::mesh;
        request.meshStepPx = stepPx;
    }
    return requests;
}

std::vector<RenderRequest> filters(const RenderRequest& base) {
    std::vector<RenderRequest> requests;
    for (const int faceSizePx : {0, 512, 1024, 2048, 4096}) {
        for (const SourceFilter filter : {SourceFilter::nearest, SourceFilter::linear, SourceFilter::bicubic,
                                          SourceFilter::mipmap, SourceFilter::anisotropic}) {
            RenderRequest& request = requests.emplace_back(base);
            request.faceSizePx = faceSizePx;
            request.filter = filter;
        }
    }
    RenderRequest& best = requests.emplace_back(base);
    best.method = Method::piecewise;
    return requests;
}

std::vector<RenderRequest> sources(const RenderRequest& base) {
    std::vector<RenderRequest> requests;
    for (const SourceKind source : {SourceKind::cube, SourceKind::hemicube, SourceKind::planar}) {
        RenderRequest& request = requests.emplace_back(base);
        request.source = source;
    }
    return requests;
}

// Antialiasing before resampling.
std::vector<RenderRequest> supersampled(const RenderRequest& base) {
    std::vector<RenderRequest> requests;
    for (const int samples : {1, 4}) {
        for (const SourceFilter filter : {SourceFilter::linear, SourceFilter::anisotropic}) {
            RenderRequest& request = requests.emplace_back(base);
            request.samples = samples;
            request.filter = filter;
        }
    }
    return requests;
}

double stageMs(const RenderStats& stats, std::string_view stage) {
    for (const StageMs& measured : stats.stageMs)
        if (measured.stage == stage) return measured.ms;
    return 0;
}

void printRow(const std::string& display, const RenderRequest& request, const RenderStats& stats,
              const std::optional<Truth>& truth, const Frame& frame) {
    fmt::print("{},{},{},{},{},{},{},{},{},{},{},{},{:.1f},{:.1f},{:.1f},{:.4f},{:.4f}", display,
               stats.method, stats.source, stats.filter, stats.facePass, stats.lookup, request.meshStepPx,
               request.samples, stats.faceSizePx, stats.faces, stats.sourceTexels, stats.pairs,
               stats.frameMsMedian, stageMs(stats, "levels"), stageMs(stats, "resample"),
               stats.geometricError.maxPx, stats.lookupError.maxPx);
    if (truth)
        fmt::print(",{:.4f},{:.2f}", 100 * compareColor(frame, truth->centres).shareOff,
                   compareColor(frame, truth->pixels).psnrDb);
    fmt::print("\n");
    std::cout << std::flush;
}

void measureOn(const WallPtr& wall, const Display& display, const ScenePtr& scene, const Options& options) {
    RenderRequest base = requestFor(wall, scene);
    base.display = display.name;
    base.method = Method::imageBased;
    Renderer renderer;
    std::optional<Truth> truth;
    if (options.part == "filters" || options.part == "samples") truth = truthOf(renderer, base);
    const auto all = options.part == "passes"    ? passes(base)
                     : options.part == "lookups" ? lookups(base)
                     : options.part == "sources" ? sources(base)
                     : options.part == "samples" ? supersampled(base)
                                                 : filters(base);
    std::vector<RenderRequest> timed;
    std::vector<Frame> frames;
    for (RenderRequest request : all) {
        try {
            frames.push_back(renderer.render(request).frame);
        } catch (const UsageError&) {
            continue;  // no such source holds this display
        }
        request.frames = options.frames;
        request.timesStages = options.part != "passes";
        timed.push_back(request);
    }
    const std::vector<Rounds> measured = renderInTurns(renderer, timed, options.rounds);
    for (size_t i = 0; i < timed.size(); ++i)
        printRow(display.name, timed[i], medianRound(measured[i]), truth, frames[i]);
}

void measure(const Options& options) {
    const auto scene = std::make_shared<const Scene>(loadScene(options.scene));
    fmt::print(
        "display,method,source,filter,faces,lookup,mesh_step_px,samples,face_px,pictures,texels,pairs,frame_"
        "ms,"
        "levels_ms,resample_ms,error_px,lookup_error_px,wrong_percent,psnr_of_16_db\n");
    for (const std::string& file : options.walls) {
        const auto wall = std::make_shared<const Wall>(readWall(file));
        for (const Display& display : wall->displays)
            if (options.display.empty() || display.name == options.display)
                measureOn(wall, display, scene, options);
    }
}

}  // namespace
}  // namespace curvewall

int main(int argc, char** argv) {
    curvewall::Options options;
    CLI::App app("The image-based method's choices side by side, as CSV");
    app.add_option("walls", options.walls, "Wall files")->required();
    app.add_option("--part", options.part)
        ->check(CLI::IsMember({"passes", "lookups", "filters", "sources", "samples"}));
    app.add_option("--scene", options.scene);
    app.add_option("--display", options.display);
    app.add_option("--frames", options.frames);
    app.add_option("--rounds", options.rounds);
    CLI11_PARSE(app, argc, argv);
    try {
        curvewall::measure(options);
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
