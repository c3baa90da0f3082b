#include "renderer/methods/piecewise_method.h"

#include "calibration/errors.h"
#include "calibration/pieces/piece_fit.h"
#include "calibration/stopwatch.h"
#include "renderer/frame_measurement.h"
#include "renderer/names.h"

#include <chrono>
#include <string_view>

namespace curvewall {
namespace {

// The loop engine has no end on a fine mesh, and a frame in hand is finished.
void refuseEndlessLoop(const RenderRequest& request, const GpuPieces& pieces, const SampledTarget& target) {
    constexpr uint64_t kMostLoopTriangles = 1'000'000'000;
    const uint64_t drawn =
        request.scene->triangles.size() * static_cast<uint64_t>(pieces.pieceCount) * target.passCount();
    if (request.engine == Engine::loop && drawn > kMostLoopTriangles)
        throw UsageError("the loop engine would draw " + std::to_string(drawn) +
                         " triangles a frame, more than " + std::to_string(kMostLoopTriangles) +
                         "; take another engine or a larger tolerance");
}

// llvmpipe ends all loops of a shader once they have gone round 65,535 times together. The walk over the
// pieces takes four nodes a round; what it did not reach would stay open without a word.
void refuseUnfinishedWalk(const RenderRequest& request, const GpuPieces& pieces) {
    constexpr uint32_t kMostRounds = 65'000;
    const std::string_view driver(reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
    if (request.engine != Engine::loop && pieces.nodeCount / 4 > kMostRounds &&
        driver.find("llvmpipe") != std::string_view::npos)
        throw UsageError(
            "the display takes " + std::to_string(pieces.pieceCount) +
            " pieces, more than this software renderer can look through; take a larger tolerance, "
            "or image-based");
}

double millisecondsSince(std::chrono::steady_clock::time_point time) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - time).count();
}

size_t memoryBytesOf(const PreparedPieces& prepared) {
    const size_t bytes = memoryBytesOf(prepared.gpu) + memoryBytesOf(*prepared.owners);
    return prepared.forStrokes ? bytes + memoryBytesOf(*prepared.forStrokes) : bytes;
}

std::shared_ptr<PreparedDraw> makeDraw(const RenderRequest& request, PreparedScene& scene,
                                       PreparedPieces& prepared, const SampledTarget& target,
                                       const std::shared_ptr<const GpuOwners>& sampled) {
    const SceneLook look{request.style, request.output};
    const PieceOwners whose{prepared.owners.get(), sampled.get()};
    const GeometryPath path =
        pathThrough(prepared.gpu, whose, look.output, request.engine, target.samplesAPass());
    SceneReplicators* const replicators =
        prepared.gpu.pieceCount > 1 ? &scene.replicatorsFor(request.engine) : nullptr;
    PiecewiseRenderer renderer(programsFor(scene, look, path), scene.gpu, prepared.gpu, replicators, whose);
    if (scene.gpu.strokes) {
        if (!prepared.forStrokes) prepared.forStrokes.emplace(uploadStrokePieces(prepared.fitted->mesh));
        renderer.addStrokes(std::make_unique<StrokeRenderer>(strokeProgramsFor(scene, look, path.closesHoles),
                                                             scene.gpu, *scene.gpu.strokes,
                                                             *prepared.forStrokes, whose.ofPixels));
    }
    return std::make_shared<PreparedDraw>(PreparedDraw{sampled, std::move(renderer)});
}

}  // namespace

std::shared_ptr<PreparedPieces> PiecewiseMethod::preparedPieces(const RenderRequest& request,
                                                                const Display& display) {
    return pieces_.get({request.wall, &display, request.tolerancePx, request.pieces}, [&] {
        const auto fitted =
            request.pieces ? request.pieces
                           : std::make_shared<const FittedPieces>(fitPieces(display, request.tolerancePx));
        const auto gpuOwners = owners_.get(fitted->owners, [&] {
            return std::make_shared<const GpuOwners>(uploadOwners(*fitted->owners, display.sizePx));
        });
        return std::make_shared<PreparedPieces>(
            PreparedPieces{uploadPieces(fitted->mesh), fitted, gpuOwners});
    });
}

// Whose each sample is, where that matters.
std::shared_ptr<const GpuOwners> PiecewiseMethod::sampleOwnersFor(const PreparedScene& scene,
                                                                  const PreparedPieces& prepared,
                                                                  const SampledTarget& target, int samples) {
    if (samples == 1 || !scene.gpu.blended || prepared.gpu.pieceCount == 1) return nullptr;
    return sampleOwners_.get({prepared.fitted->owners, samples}, [&] {
        return std::make_shared<const GpuOwners>(
            uploadSampleOwners(prepared.fitted->mesh, target.sampleOffsetsPx()));
    });
}

std::shared_ptr<PreparedDraw> PiecewiseMethod::preparedDraw(const RenderRequest& request,
                                                            const std::shared_ptr<PreparedScene>& scene,
                                                            const std::shared_ptr<PreparedPieces>& prepared,
                                                            const SampledTarget& target, int samples) {
    const DrawKey key{prepared, request.engine, request.style, request.output, samples};
    const auto sampled = sampleOwnersFor(*scene, *prepared, target, samples);
    const auto make = [&] { return makeDraw(request, *scene, *prepared, target, sampled); };
    // Owners of samples are large: few renderers may hold on to theirs.
    return sampled ? sampledDraws_.get({scene, key}, make) : scene->draws.get(key, make);
}

RenderResult PiecewiseMethod::render(const RenderRequest& request, const Display& display) {
    RenderResult result;
    RenderStats& stats = result.stats;
    const Stopwatch preparing;
    const auto scene = resources_.sceneFor(request);
    const auto prepared = preparedPieces(request, display);
    const int samples = samplesFor(request);
    const auto keptBlended = resources_.blendedTarget(request, display);
    const BlendedTarget& blended = *keptBlended;
    const auto kept = resources_.sampledTarget(display.sizePx, blended.pictureFormat(), samples);
    const SampledTarget& target = *kept;
    refuseEndlessLoop(request, prepared->gpu, target);
    refuseUnfinishedWalk(request, prepared->gpu);
    const auto drawn = preparedDraw(request, scene, prepared, target, samples);
    drawn->renderer.timeStages(request.timesStages);
    stats.prepareMs = preparing.ms();

    FrameOutcome outcome;
    const auto draw = [&](const Camera& camera) {
        const SceneView view = sceneViewOf(camera, request.wall->eyeM, *request.scene);
        outcome = drawUntilItFits(drawn->renderer, [&] {
            target.draw(request.wall->background,
                        [&](const FramePass& pass) { drawn->renderer.record(view, pass); });
            blended.record(target.picture());
        });
    };
    const auto readFirst = [&] {
        result.frame = blended.read(target.picture());
        stats.pairs = outcome.pairCount;
        stats.meshletsDrawn = outcome.meshletCount;
    };
    measureFrames(request, {draw, readFirst, [&] { return drawn->renderer.takeStageTimes(); }}, stats);
    describe(*scene, drawn->renderer.programs(), stats);
    if (prepared->gpu.pieceCount > 1)
        stats.gpuMemoryMib.pairs = mebibytes(memoryBytesOf(scene->replicatorsFor(request.engine)));
    describeMemory(memoryBytesOf(*prepared) + (drawn->sampleOwners ? memoryBytesOf(*drawn->sampleOwners) : 0),
                   target.memoryBytes(), blended, stats);
    stats.method = "piecewise";
    stats.engine = prepared->gpu.pieceCount > 1 ? nameOf(request.engine) : "plain";
    stats.tolerancePx = request.tolerancePx;
    stats.geometricError = errorOf(prepared->fitted->certificate);
    stats.pieces = prepared->gpu.pieceCount;
    stats.certificateEvery = prepared->fitted->certificate.every;
    stats.fullCertificateAgeMs = millisecondsSince(prepared->fitted->fullyCertifiedAt);
    return result;
}

}  // namespace curvewall
