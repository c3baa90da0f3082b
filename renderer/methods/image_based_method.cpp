#include "renderer/methods/image_based_method.h"

#include "calibration/stopwatch.h"
#include "renderer/frame_measurement.h"
#include "renderer/names.h"

namespace curvewall {

RenderResult ImageBasedMethod::render(const RenderRequest& request, const Display& display) {
    RenderResult result;
    RenderStats& stats = result.stats;
    const Stopwatch preparing;
    const auto scene = resources_.sceneFor(request);
    const auto source = images_.source(request.wall, display, request.source, request.faceSizePx);
    const auto renderer = scene->images.get({source, request.style, request.output}, [&] {
        const GeometryPath onePiece;
        return std::make_shared<ImageBasedRenderer>(
            programsFor(*scene, {request.style, request.output}, onePiece), scene->gpu, source->gpu);
    });
    const auto keptBlended = resources_.blendedTarget(request, display);
    const BlendedTarget& blended = *keptBlended;
    const TargetFormat format = blended.pictureFormat();
    const auto pictures = images_.pictures(source->gpu, format, samplesFor(request));
    const SourceFilter filter = filterFor(request.output, request.filter);
    const auto resampler = images_.resampler(filter);
    const auto keptTarget = resources_.frameTarget(display.sizePx, format);
    const FrameTarget& target = *keptTarget;
    renderer->timeStages(request.timesStages);
    stats.prepareMs = preparing.ms();

    FrameOutcome outcome;
    const auto draw = [&](const Camera& camera) {
        const SceneView view = sceneViewOf(camera, request.wall->eyeM, *request.scene);
        do {
            renderer->record(view, *pictures, *resampler, target, request.wall->background);
            blended.record(target);
            waitForGpu();
            outcome = renderer->finishFrame();
        } while (outcome.overflowed);
    };
    const auto readFirst = [&] {
        result.frame = blended.read(target);
        stats.pairs = outcome.pairCount;
        stats.meshletsDrawn = outcome.meshletCount;
    };
    measureFrames(request, {draw, readFirst, [&] { return renderer->takeStageTimes(); }}, stats);
    describe(*scene, renderer->programs(), stats);
    stats.method = "image-based";
    stats.engine = nameOf(request.source);
    stats.source = nameOf(request.source);
    stats.filter = nameOf(filter);
    stats.geometricError = errorOf(source->error);
    stats.faceSizePx = source->gpu.faceSizePx;
    stats.faces = static_cast<int>(source->gpu.faces.size());
    return result;
}

}  // namespace curvewall
