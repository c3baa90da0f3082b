#include "renderer/methods/bounded_raycast_method.h"

#include "calibration/errors.h"
#include "calibration/stopwatch.h"
#include "renderer/frame_measurement.h"
#include "renderer/names.h"
#include "renderer/shown_error.h"

#include <glm/matrix.hpp>

namespace curvewall {
namespace {

void refuseStrokes(const Scene& scene) {
    if (scene.points.empty() && scene.lines.empty()) return;
    throw UsageError("bounded-raycast draws triangles only, and the scene has " +
                     std::to_string(scene.points.size()) + " points and " +
                     std::to_string(scene.lines.size()) + " lines");
}

SceneView viewThrough(const RoundLens& lens, const Camera& camera, const RenderRequest& request) {
    return sceneViewOf(camera, request.wall->eyeM, *request.scene, glm::transpose(lens.wallFromLens));
}

const std::vector<glm::dvec2> kPixelCentre{glm::dvec2(0.5)};

}  // namespace

std::shared_ptr<LensRays> BoundedRaycastMethod::raysFor(const RoundLens& lens, int samples) {
    return rays_.get({lens, samples}, [&] { return std::make_shared<LensRays>(lens, samples); });
}

// Those of frame 0, whatever hides them.
uint64_t BoundedRaycastMethod::countFragments(const RenderRequest& request, PreparedScene& scene,
                                              const RoundLens& lens, BoundedPath::Fragments fragments) {
    const SceneLook look{Style::unlit, OutputKind::coverage};
    const auto rays = raysFor(lens, 1);
    BoundedRaycastRenderer renderer(
        programsFor(scene, look, boundedPathThrough(lens, request.bounds, 1, fragments)), scene.gpu, *rays,
        kPixelCentre);
    GLuint id = 0;
    glCreateQueries(GL_SAMPLES_PASSED, 1, &id);
    const GlQuery query(id);
    resources_.frameTarget(lens.sizePx, {look.output, false})->begin(glm::vec3(0));
    glBeginQuery(GL_SAMPLES_PASSED, id);
    renderer.record(viewThrough(lens, request.camera, request), {});
    glEndQuery(GL_SAMPLES_PASSED);
    GLuint64 count = 0;
    glGetQueryObjectui64v(id, GL_QUERY_RESULT, &count);
    return count;
}

Certificate BoundedRaycastMethod::measureError(const RenderRequest& request, const Display& display,
                                               PreparedScene& scene, const RoundLens& lens) {
    const SceneLook look{Style::unlit, OutputKind::position};
    const auto rays = raysFor(lens, 1);
    BoundedRaycastRenderer renderer(programsFor(scene, look, boundedPathThrough(lens, request.bounds, 1)),
                                    scene.gpu, *rays, kPixelCentre);
    const auto target = resources_.frameTarget(lens.sizePx, {look.output, false});
    target->begin(glm::vec3(0));
    renderer.record(viewThrough(lens, request.camera, request), {});
    return shownError(target->read(), display);
}

RenderResult BoundedRaycastMethod::render(const RenderRequest& request, const Display& display) {
    RenderResult result;
    RenderStats& stats = result.stats;
    const Stopwatch preparing;
    const RoundLens lens = roundLensOf(display);
    refuseStrokes(*request.scene);
    const auto scene = resources_.sceneFor(request);
    const auto keptBlended = resources_.blendedTarget(request, display);
    const BlendedTarget& blended = *keptBlended;
    const auto kept = resources_.sampledTarget(display.sizePx, blended.pictureFormat(), samplesFor(request));
    const SampledTarget& target = *kept;
    const auto rays = raysFor(lens, target.samplesAPass());
    BoundedRaycastRenderer renderer(
        programsFor(*scene, {request.style, request.output},
                    boundedPathThrough(lens, request.bounds, target.samplesAPass())),
        scene->gpu, *rays, target.sampleOffsetsPx());
    renderer.timeStages(request.timesStages);
    stats.prepareMs = preparing.ms();

    const auto draw = [&](const Camera& camera) {
        const SceneView view = viewThrough(lens, camera, request);
        target.draw(request.wall->background, [&](const FramePass& pass) { renderer.record(view, pass); });
        blended.record(target.picture());
        waitForGpu();
    };
    const auto readFirst = [&] {
        result.frame = blended.read(target.picture());
        stats.pairs = renderer.outcome().pairCount;
        stats.meshletsDrawn = renderer.outcome().meshletCount;
    };
    measureFrames(request, {draw, readFirst, [&] { return renderer.takeStageTimes(); }}, stats);
    describe(*scene, renderer.programs(), stats);
    describeMemory(sizeOf(rays->texture()), target.memoryBytes(), blended, stats);
    stats.method = nameOf(request.method);
    stats.engine = stats.bounds = nameOf(request.bounds);
    if (request.measuresError) {
        stats.geometricError = errorOf(measureError(request, display, *scene, lens));
        stats.coveredFragments = countFragments(request, *scene, lens, BoundedPath::Fragments::covered);
        stats.renderedFragments = countFragments(request, *scene, lens, BoundedPath::Fragments::hits);
    }
    return result;
}

}  // namespace curvewall
