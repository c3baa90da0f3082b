#include "renderer/render.h"

#include "calibration/errors.h"
#include "calibration/pieces/piece_fit.h"
#include "calibration/stopwatch.h"
#include "renderer/blended_target.h"
#include "renderer/blending.h"
#include "renderer/frame_measurement.h"
#include "renderer/gl/egl_context.h"
#include "renderer/gpu_edges.h"
#include "renderer/names.h"
#include "renderer/prepared_images.h"
#include "renderer/prepared_scene.h"
#include "renderer/recently_used.h"
#include "renderer/reference.h"
#include "renderer/sampled_target.h"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <stdexcept>

namespace curvewall {
namespace {

double peakMemoryMib() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024;
}

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

double mebibytes(size_t bytes) { return static_cast<double>(bytes) / (1024.0 * 1024.0); }

void describe(const PreparedScene& scene, const ScenePrograms& programs, RenderStats& stats) {
    stats.meshlets = meshletCountOf(scene.gpu);
    stats.attributes = programs.attributes();
    stats.sceneMemoryMib = mebibytes(memoryBytesOf(scene.gpu));
}

GeometricError errorOf(const Certificate& certificate) {
    return {certificate.maxPx, certificate.p99Px, certificate.meanPx};
}

double millisecondsSince(std::chrono::steady_clock::time_point time) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - time).count();
}

struct EyeKey {
    WallPtr wall;
    glm::dvec3 eyeM;
    bool operator==(const EyeKey&) const = default;
};

struct PiecesKey {
    WallPtr wall;
    const Display* display;  // of that wall
    double tolerancePx;
    std::shared_ptr<const FittedPieces> pieces;  // those that came with the request
    bool operator==(const PiecesKey&) const = default;
};

struct TargetKey {
    glm::ivec2 sizePx;
    TargetFormat format;
    int samples;
    bool operator==(const TargetKey&) const = default;
};

struct FrameTargetKey {
    glm::ivec2 sizePx;
    TargetFormat format;
    bool operator==(const FrameTargetKey&) const = default;
};

struct BlendedTargetKey {
    glm::ivec2 sizePx;
    TargetFormat format;
    std::shared_ptr<const GpuBlend> maps;
    bool operator==(const BlendedTargetKey&) const = default;
};

struct SampledDrawKey {
    std::shared_ptr<PreparedScene> scene;
    DrawKey draw;
    bool operator==(const SampledDrawKey&) const = default;
};

struct OwnersKey {
    OwnersPtr owners;
    int samples;
    bool operator==(const OwnersKey&) const = default;
};

// Waits until the GPU has done everything recorded so far.
void waitForGpu() {
    const GLsync fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    constexpr GLuint64 kOneSecondNs = 1'000'000'000;
    GLenum status = GL_TIMEOUT_EXPIRED;
    while (status == GL_TIMEOUT_EXPIRED)
        status = glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, kOneSecondNs);
    glDeleteSync(fence);
    if (status == GL_WAIT_FAILED) throw std::runtime_error("OpenGL failed in the middle of a frame");
}

}  // namespace

// The GL objects are declared after the context, so that they go first.
struct Renderer::Impl {
    explicit Impl(size_t mostScenes) : references(mostScenes), scenes(mostScenes) {}

    std::optional<EglContext> context;
    RecentlyUsed<EyeKey, const Wall> movedWalls{16};
    RecentlyUsed<ScenePtr, ReferenceRenderer> references;
    RecentlyUsed<BlendMapsPtr, const GpuBlend> blends{16};
    RecentlyUsed<PiecesKey, PreparedPieces> pieces{16};
    RecentlyUsed<OwnersPtr, const GpuOwners> owners{16};
    RecentlyUsed<OwnersKey, const GpuOwners> sampleOwners{2};
    PreparedImages images;
    RecentlyUsed<TargetKey, const SampledTarget> targets{2};  // large
    RecentlyUsed<FrameTargetKey, const FrameTarget> frameTargets{2};
    RecentlyUsed<BlendedTargetKey, const BlendedTarget> blendedTargets{2};
    RecentlyUsed<ScenePtr, PreparedScene> scenes;
    RecentlyUsed<SampledDrawKey, PreparedDraw> sampledDraws{2};

    std::shared_ptr<PreparedScene> preparedScene(const ScenePtr& scene) {
        return scenes.get(scene, [&] { return std::make_shared<PreparedScene>(scene); });
    }

    std::shared_ptr<PreparedPieces> preparedPieces(const RenderRequest& request, const Display& display) {
        return pieces.get({request.wall, &display, request.tolerancePx, request.pieces}, [&] {
            const auto fitted =
                request.pieces
                    ? request.pieces
                    : std::make_shared<const FittedPieces>(fitPieces(display, request.tolerancePx));
            const auto gpuOwners = owners.get(fitted->owners, [&] {
                return std::make_shared<const GpuOwners>(uploadOwners(*fitted->owners, display.sizePx));
            });
            return std::make_shared<PreparedPieces>(
                PreparedPieces{uploadPieces(fitted->mesh), fitted, gpuOwners});
        });
    }

    // Programs do not depend on where the pieces are, so that an eye that moves compiles nothing.
    static std::shared_ptr<const ScenePrograms> programsFor(PreparedScene& scene, SceneLook look,
                                                            const GeometryPath& path) {
        return scene.programs.get({look.style, look.output, path}, [&] {
            return std::make_shared<const ScenePrograms>(*scene.gpu.scene, look, path);
        });
    }

    static std::shared_ptr<const StrokePrograms> strokeProgramsFor(PreparedScene& scene, SceneLook look,
                                                                   bool holes) {
        return scene.strokePrograms.get({look.style, look.output, holes}, [&] {
            return std::make_shared<const StrokePrograms>(*scene.gpu.scene, look, holes);
        });
    }

    std::shared_ptr<const SampledTarget> sampledTarget(glm::ivec2 sizePx, TargetFormat format, int samples) {
        return targets.get({sizePx, format, samples},
                           [&] { return std::make_shared<const SampledTarget>(sizePx, format, samples); });
    }

    // Whose each sample is, where that matters.
    std::shared_ptr<const GpuOwners> sampleOwnersFor(const PreparedScene& scene,
                                                     const PreparedPieces& prepared,
                                                     const SampledTarget& target, int samples) {
        if (samples == 1 || !scene.gpu.blended || prepared.gpu.pieceCount == 1) return nullptr;
        return sampleOwners.get({prepared.fitted->owners, samples}, [&] {
            return std::make_shared<const GpuOwners>(
                uploadSampleOwners(prepared.fitted->mesh, target.sampleOffsetsPx()));
        });
    }

    std::shared_ptr<PreparedDraw> preparedDraw(const RenderRequest& request,
                                               const std::shared_ptr<PreparedScene>& scene,
                                               const std::shared_ptr<PreparedPieces>& prepared,
                                               const SampledTarget& target, int samples) {
        const DrawKey key{prepared, request.engine, request.style, request.output, samples};
        const auto sampled = sampleOwnersFor(*scene, *prepared, target, samples);
        const auto make = [&] { return makeDraw(request, *scene, *prepared, target, sampled); };
        // Owners of samples are large: few renderers may hold on to theirs.
        return sampled ? sampledDraws.get({scene, key}, make) : scene->draws.get(key, make);
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
        PiecewiseRenderer renderer(programsFor(scene, look, path), scene.gpu, prepared.gpu, replicators,
                                   whose);
        if (scene.gpu.strokes) {
            if (!prepared.forStrokes) prepared.forStrokes.emplace(uploadStrokePieces(prepared.fitted->mesh));
            renderer.addStrokes(
                std::make_unique<StrokeRenderer>(strokeProgramsFor(scene, look, path.closesHoles), scene.gpu,
                                                 *scene.gpu.strokes, *prepared.forStrokes, whose.ofPixels));
        }
        return std::make_shared<PreparedDraw>(PreparedDraw{sampled, std::move(renderer)});
    }

    // What the frames of a request end in, with the display's maps where it has any.
    std::shared_ptr<const BlendedTarget> targetFor(const RenderRequest& request, const Display& display) {
        std::shared_ptr<const GpuBlend> maps;
        if (display.blend && request.output == OutputKind::color)
            maps = blends.get(display.blend, [&] {
                return std::make_shared<const GpuBlend>(uploadBlend(*display.blend, display.sizePx));
            });
        const TargetFormat format{request.output, request.linearOutput};
        return blendedTargets.get({display.sizePx, format, maps}, [&] {
            return std::make_shared<const BlendedTarget>(display.sizePx, format, maps);
        });
    }

    RenderResult piecewise(const RenderRequest& request, const Display& display);
    RenderResult imageBased(const RenderRequest& request, const Display& display);
    RenderResult reference(const RenderRequest& request, const Display& display);
};

RenderResult Renderer::Impl::piecewise(const RenderRequest& request, const Display& display) {
    RenderResult result;
    RenderStats& stats = result.stats;
    const Stopwatch preparing;
    const auto scene = preparedScene(request.scene);
    if (drawsEdges(request.style, request.output)) uploadEdges(scene->gpu);
    const auto prepared = preparedPieces(request, display);
    // Distances, counts and points are those of the pixel's centre: there is no average of them.
    const int samples = request.output == OutputKind::color ? request.samples : 1;
    const auto keptBlended = targetFor(request, display);
    const BlendedTarget& blended = *keptBlended;
    const auto kept = sampledTarget(display.sizePx, blended.pictureFormat(), samples);
    const SampledTarget& target = *kept;
    refuseEndlessLoop(request, prepared->gpu, target);
    const auto drawn = preparedDraw(request, scene, prepared, target, samples);
    drawn->renderer.timeStages(request.timesStages);
    stats.prepareMs = preparing.ms();

    FrameOutcome outcome;
    const auto draw = [&](const Camera& camera) {
        const SceneView view = sceneViewOf(camera, request.wall->eyeM, *request.scene);
        do {
            target.draw(request.wall->background,
                        [&](const FramePass& pass) { drawn->renderer.record(view, pass); });
            blended.record(target.picture());
            waitForGpu();
            outcome = drawn->renderer.finishFrame();
        } while (outcome.overflowed);
    };
    const auto readFirst = [&] {
        result.frame = blended.read(target.picture());
        stats.pairs = outcome.pairCount;
        stats.meshletsDrawn = outcome.meshletCount;
    };
    measureFrames(request, {draw, readFirst, [&] { return drawn->renderer.takeStageTimes(); }}, stats);
    describe(*scene, drawn->renderer.programs(), stats);
    if (prepared->gpu.pieceCount > 1)
        stats.pairsMemoryMib = mebibytes(memoryBytesOf(scene->replicatorsFor(request.engine)));
    stats.method = "piecewise";
    stats.engine = prepared->gpu.pieceCount > 1 ? nameOf(request.engine) : "plain";
    stats.tolerancePx = request.tolerancePx;
    stats.geometricError = errorOf(prepared->fitted->certificate);
    stats.pieces = prepared->gpu.pieceCount;
    stats.certificateEvery = prepared->fitted->certificate.every;
    stats.fullCertificateAgeMs = millisecondsSince(prepared->fitted->fullyCertifiedAt);
    return result;
}

RenderResult Renderer::Impl::imageBased(const RenderRequest& request, const Display& display) {
    RenderResult result;
    RenderStats& stats = result.stats;
    const Stopwatch preparing;
    const auto scene = preparedScene(request.scene);
    if (drawsEdges(request.style, request.output)) uploadEdges(scene->gpu);
    const auto source = images.source(request.wall, display, request.source, request.faceSizePx);
    const auto renderer = scene->images.get({source, request.style, request.output}, [&] {
        const GeometryPath onePiece;
        return std::make_shared<ImageBasedRenderer>(
            programsFor(*scene, {request.style, request.output}, onePiece), scene->gpu, source->gpu);
    });
    const auto keptBlended = targetFor(request, display);
    const BlendedTarget& blended = *keptBlended;
    const TargetFormat format = blended.pictureFormat();
    const int samples = request.output == OutputKind::color ? request.samples : 1;
    const auto pictures = images.pictures(source->gpu, format, samples);
    const SourceFilter filter = filterFor(request.output, request.filter);
    const auto resampler = images.resampler(filter);
    const auto keptTarget = frameTargets.get({display.sizePx, format}, [&] {
        return std::make_shared<const FrameTarget>(display.sizePx, format, 1);
    });
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

RenderResult Renderer::Impl::reference(const RenderRequest& request, const Display& display) {
    RenderResult result;
    const Stopwatch preparing;
    const auto renderer =
        references.get(request.scene, [&] { return std::make_shared<ReferenceRenderer>(request.scene); });
    result.stats.prepareMs = preparing.ms();
    Frame latest;
    const auto draw = [&](const Camera& camera) {
        latest = renderer->render(*request.wall, display, camera,
                                  {request.style, request.output, request.samples});
        if (display.blend && request.output == OutputKind::color)
            blend(latest, *display.blend, mostLight(request.linearOutput));
    };
    measureFrames(request, {draw, [&] { result.frame = std::move(latest); }}, result.stats);
    result.stats.method = "reference";
    result.stats.engine = "embree";
    result.stats.pairs = request.scene->triangles.size();
    return result;
}

Renderer::Renderer(size_t mostScenes) : impl_(std::make_unique<Impl>(mostScenes)) {}
Renderer::~Renderer() = default;

RenderResult Renderer::render(const RenderRequest& asked) {
    RenderRequest request = asked;
    if (asked.eyeM)
        request.wall = impl_->movedWalls.get({asked.wall, *asked.eyeM}, [&] {
            return std::make_shared<const Wall>(seenFrom(*asked.wall, *asked.eyeM));
        });
    const Display& display = findDisplay(*request.wall, request.display);
    if (request.method != Method::reference) {
        if (!impl_->context) impl_->context.emplace();
        const int usual = impl_->context->isSoftware() ? 1 : kMostAnisotropy;
        setAnisotropy(impl_->preparedScene(request.scene)->gpu, request.anisotropy.value_or(usual));
    }
    RenderResult result;
    switch (request.method) {
        case Method::piecewise:
            result = impl_->piecewise(request, display);
            break;
        case Method::imageBased:
            result = impl_->imageBased(request, display);
            break;
        case Method::reference:
            result = impl_->reference(request, display);
            break;
    }
    result.stats.triangles = request.scene->triangles.size();
    result.stats.samples = request.samples;
    result.stats.frames = request.frames;
    result.stats.peakMemoryMib = peakMemoryMib();
    if (request.method != Method::reference) result.stats.glRenderer = impl_->context->rendererName();
    return result;
}

}  // namespace curvewall
