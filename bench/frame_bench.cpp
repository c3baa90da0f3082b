// Milliseconds a frame, each beside its error: the median of frames that turn the camera once around, warm.

#include "bench/request.h"
#include "renderer/render.h"
#include "renderer/scene/load_scene.h"
#include "tests/support/test_walls.h"

#include <benchmark/benchmark.h>

#include <memory>

namespace curvewall {
namespace {

constexpr glm::ivec2 kSizePx(1600, 1200);
constexpr int kFrames = 36;

RenderRequest cityRequest(Wall wall) {
    static const ScenePtr city = std::make_shared<const Scene>(loadScene("city"));
    return requestFor(std::make_shared<const Wall>(std::move(wall)), city, kFrames);
}

void measure(benchmark::State& state, const RenderRequest& request) {
    Renderer renderer;
    RenderStats stats;
    for (auto _ : state) {
        stats = renderer.render(request).stats;
        state.SetIterationTime(stats.frameMsMedian / 1000);
    }
    state.counters["max_error_px"] = stats.geometricError.maxPx;
    state.counters["pairs_per_triangle"] = stats.replicationRatio();
    state.SetLabel(stats.engine);
}

// One piece: what the scene costs as a plain perspective picture.
void planar90(benchmark::State& state) { measure(state, cityRequest(test::planarWall(kSizePx, 90))); }
BENCHMARK(planar90)->UseManualTime()->Iterations(3)->Unit(benchmark::kMillisecond);

void fullCylinderPiecewise(benchmark::State& state) {
    RenderRequest request = cityRequest(test::fullCylinderWall(kSizePx));
    request.tolerancePx = static_cast<double>(state.range(0)) / 1000;
    measure(state, request);
}
BENCHMARK(fullCylinderPiecewise)
    ->ArgName("tolerance_mpx")
    ->Arg(1000)
    ->Arg(250)
    ->Arg(50)
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

void fullCylinderImageBased(benchmark::State& state) {
    RenderRequest request = cityRequest(test::fullCylinderWall(kSizePx));
    request.method = Method::imageBased;
    request.faceSizePx = static_cast<int>(state.range(0));
    measure(state, request);
}
BENCHMARK(fullCylinderImageBased)
    ->ArgName("face_px")
    ->Arg(512)
    ->Arg(1024)
    ->Arg(2048)
    ->UseManualTime()
    ->Iterations(3)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace curvewall
