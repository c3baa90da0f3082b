#include "renderer/methods/image_based_method.h"

#include "calibration/stopwatch.h"
#include "renderer/frame_measurement.h"
#include "renderer/names.h"

namespace curvewall {
namespace {

SourceSettings settingsOf(const RenderRequest& request, SourceFilter filter) {
    return {request.source,     request.faceSizePx,
            usesLevels(filter), request.facePass,
            request.lookup,     request.lookup == SourceLookup::mesh ? request.meshStepPx : 0};
}

}  // namespace

RenderResult ImageBasedMethod::render(const RenderRequest& request, const Display& display) {
    RenderResult result;
    RenderStats& stats = result.stats;
    const Stopwatch preparing;
    const auto scene = resources_.sceneFor(request);
    const SourceFilter filter = filterFor(request.output, request.filter);
    const auto source = images_.source(request.wall, display, settingsOf(request, filter));
    const auto renderer = scene->images.get({source, request.style, request.output}, [&] {
        return std::make_shared<ImageBasedRenderer>(
            programsFor(*scene, {request.style, request.output}, pathThrough(source->gpu)), scene->gpu,
            source->gpu);
    });
    const auto keptBlended = resources_.blendedTarget(request, display);
    const BlendedTarget& blended = *keptBlended;
    const TargetFormat format = blended.pictureFormat();
    const auto pictures = images_.pictures(source->gpu, format, samplesFor(request));
    const auto resampler = images_.resampler(filter, request.lookup);
    const auto keptTarget = resources_.frameTarget(display.sizePx, format);
    const FrameTarget& target = *keptTarget;
    renderer->timeStages(request.timesStages);
    stats.prepareMs = preparing.ms();

    FrameOutcome outcome;
    const auto draw = [&](const Camera& camera) {
        const SceneView view = sceneViewOf(camera, request.wall->eyeM, *request.scene);
        outcome = drawUntilItFits(*renderer, [&] {
            renderer->record(view, *pictures, *resampler, target, request.wall->background);
            blended.record(target);
        });
    };
    const auto readFirst = [&] {
        result.frame = blended.read(target);
        stats.pairs = outcome.pairCount;
        stats.meshletsDrawn = outcome.meshletCount;
    };
    measureFrames(request, {draw, readFirst, [&] { return renderer->takeStageTimes(); }}, stats);
    describe(*scene, renderer->programs(), stats);
    describeMemory(memoryBytesOf(source->gpu), pictures->memoryBytes() + target.memoryBytes(), blended,
                   stats);
    stats.method = "image-based";
    stats.engine = nameOf(request.source);
    stats.source = nameOf(request.source);
    stats.filter = nameOf(filter);
    stats.geometricError = errorOf(source->error);
    stats.facePass = nameOf(request.facePass);
    stats.lookup = nameOf(request.lookup);
    stats.lookupError = errorOf(source->lookupError);
    if (request.lookup == SourceLookup::mesh) stats.meshStepPx = request.meshStepPx;
    stats.faceSizePx = source->gpu.faceSizePx;
    stats.faces = static_cast<int>(source->gpu.layout.sizesPx.size());
    stats.sourceTexels = source->gpu.texelCount;
    stats.levels = source->gpu.layout.levels;
    return result;
}

}  // namespace curvewall
