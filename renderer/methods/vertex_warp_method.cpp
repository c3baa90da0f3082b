#include "renderer/methods/vertex_warp_method.h"

#include "calibration/errors.h"
#include "calibration/pieces/ownership.h"
#include "calibration/stopwatch.h"
#include "renderer/frame_measurement.h"
#include "renderer/shown_error.h"

namespace curvewall {
namespace {

// As the owners of a mesh of one piece that covers the display.
std::vector<int32_t> shownPixels(const PixelRays& rays) {
    std::vector<int32_t> owners;
    for (int y = 0; y < rays.sizePx().y; ++y)
        for (int x = 0; x < rays.sizePx().x; ++x) owners.push_back(rays.has({x, y}) ? 0 : kNoPiece);
    return owners;
}

std::shared_ptr<PreparedWarp> prepareDraw(const RenderRequest& request, PreparedScene& scene,
                                          const std::shared_ptr<const GpuWarp>& warp) {
    const auto parts = scene.parts.get(
        warp->map->defines, [&] { return std::make_shared<SceneParts>(scene.gpu, warp->map->defines); });
    const SceneLook look{request.style, request.output};
    return std::make_shared<PreparedWarp>(
        PreparedWarp{warp, parts,
                     VertexWarpRenderer(programsFor(scene, look, pathThrough(*warp, look.output)), scene.gpu,
                                        *warp, *parts)});
}

}  // namespace

std::shared_ptr<const GpuWarp> VertexWarpMethod::preparedWarp(const RenderRequest& request,
                                                              const Display& display) {
    const auto prepared = displays_.get({request.wall, &display}, [&] {
        PixelRays rays(*display.projection, display.sizePx);
        rays.keep({});
        return std::make_shared<const PreparedDisplay>(PreparedDisplay{
            std::make_shared<const GpuScreenMap>(uploadScreenMap(screenMapOf(display, rays))),
            std::make_shared<const GpuOwners>(uploadOwners(shownPixels(rays), display.sizePx))});
    });
    return warps_.get({prepared, request.tessellationPx}, [&] {
        return std::make_shared<const GpuWarp>(
            makeWarp(prepared->map, prepared->owners, display.sizePx, request.tessellationPx));
    });
}

RenderResult VertexWarpMethod::render(const RenderRequest& request, const Display& display) {
    RenderResult result;
    RenderStats& stats = result.stats;
    const Stopwatch preparing;
    const auto scene = resources_.sceneFor(request);
    if (scene->gpu.strokes)
        throw UsageError(
            "vertex-warp draws no points and lines, and the scene has some; piecewise, "
            "image-based and reference draw them");
    const auto warp = preparedWarp(request, display);
    const auto keptBlended = resources_.blendedTarget(request, display);
    const BlendedTarget& blended = *keptBlended;
    const auto keptTarget =
        resources_.sampledTarget(display.sizePx, blended.pictureFormat(), samplesFor(request));
    const SampledTarget& target = *keptTarget;
    const auto drawn = scene->warps.get({warp, request.style, request.output},
                                        [&] { return prepareDraw(request, *scene, warp); });
    VertexWarpRenderer& renderer = drawn->renderer;
    renderer.timeStages(request.timesStages);
    stats.prepareMs = preparing.ms();

    FrameOutcome outcome;
    const auto draw = [&](const Camera& camera) {
        const SceneView view = sceneViewOf(camera, request.wall->eyeM, *request.scene);
        outcome = drawUntilItFits(renderer, [&] {
            target.draw(request.wall->background,
                        [&](const FramePass& pass) { renderer.record(view, pass); });
            blended.record(target.picture());
        });
    };
    const auto readFirst = [&] {
        result.frame = blended.read(target.picture());
        stats.pairs = outcome.pairCount;
        stats.meshletsDrawn = outcome.meshletCount;
    };
    measureFrames(request, {draw, readFirst, [&] { return renderer.takeStageTimes(); }}, stats);
    describe(*scene, renderer.programs(), stats);
    stats.gpuMemoryMib.pairs = mebibytes(drawn->parts->memoryBytes());
    describeMemory(sizeOf(warp->map->table) + memoryBytesOf(*warp->owners), target.memoryBytes(), blended,
                   stats);
    stats.method = "vertex-warp";
    stats.engine = warp->tessellates ? "tessellation" : "vertex";
    stats.tessellationPx = request.tessellationPx;
    if (request.measuresError) stats.geometricError = measuredError(request, display);
    return result;
}

GeometricError VertexWarpMethod::measuredError(const RenderRequest& request, const Display& display) {
    RenderRequest positions = request;
    positions.output = OutputKind::position;
    positions.frames = 1;
    positions.measuresError = positions.timesStages = false;
    return errorOf(shownError(render(positions, display).frame, display));
}

}  // namespace curvewall
