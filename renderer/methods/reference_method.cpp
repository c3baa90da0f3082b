#include "renderer/methods/reference_method.h"

#include "calibration/stopwatch.h"
#include "renderer/blending.h"
#include "renderer/frame_measurement.h"

#include <utility>

namespace curvewall {

RenderResult ReferenceMethod::render(const RenderRequest& request, const Display& display) {
    RenderResult result;
    const Stopwatch preparing;
    const auto renderer =
        references_.get(request.scene, [&] { return std::make_shared<ReferenceRenderer>(request.scene); });
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

}  // namespace curvewall
