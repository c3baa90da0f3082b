// What it takes to fit and to certify the pieces of a wall. The column CPU is what one core takes for it.

#include "calibration/pieces/ownership.h"
#include "calibration/pieces/piece_fit.h"
#include "calibration/pieces/piece_tree.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"
#include "tests/support/test_walls.h"

#include <benchmark/benchmark.h>

#include <numbers>

namespace curvewall {
namespace {

constexpr glm::ivec2 kSizePx(1600, 1200);

double toleranceOf(const benchmark::State& state) { return static_cast<double>(state.range(0)) / 1000; }

int everyOf(const benchmark::State& state) { return static_cast<int>(state.range(0)); }

void reportPieces(benchmark::State& state, const FittedPieces& fitted) {
    state.counters["pieces"] = static_cast<double>(fitted.mesh.pieces.size());
    state.counters["max_error_px"] = fitted.certificate.maxPx;
}

void fitFullCylinder(benchmark::State& state) {
    const Wall wall = test::fullCylinderWall(kSizePx);
    FittedPieces fitted;
    for (auto _ : state) fitted = fitPieces(*wall.displays[0].projection, kSizePx, toleranceOf(state));
    reportPieces(state, fitted);
}
BENCHMARK(fitFullCylinder)
    ->ArgName("tolerance_mpx")
    ->Arg(1000)
    ->Arg(500)
    ->Arg(250)
    ->Arg(100)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

void fitOffAxisCylinder(benchmark::State& state) {
    const Wall wall = test::fullCylinderWall(kSizePx, {1.8, 0, 0});
    FittedPieces fitted;
    for (auto _ : state) fitted = fitPieces(*wall.displays[0].projection, kSizePx, toleranceOf(state));
    reportPieces(state, fitted);
}
BENCHMARK(fitOffAxisCylinder)
    ->ArgName("tolerance_mpx")
    ->Arg(500)
    ->Arg(250)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

void certify(benchmark::State& state) {
    const Wall wall = test::fullCylinderWall(kSizePx);
    const FittedPieces fitted = fitPieces(*wall.displays[0].projection, kSizePx, 0.25);
    for (auto _ : state)
        benchmark::DoNotOptimize(
            certifyPieces(*wall.displays[0].projection, fitted.mesh, {}, everyOf(state)));
    reportPieces(state, fitted);
}
BENCHMARK(certify)->ArgName("every")->Arg(1)->Arg(8)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

// Equidistant, 180 degrees; what each ray costs dominates.
void certifyFisheye(benchmark::State& state) {
    const glm::ivec2 sizePx(2048);
    const LensProjection fisheye(circularLens({RadialModel::equidistant}, std::numbers::pi, sizePx), {});
    const FittedPieces fitted = fitPieces(fisheye, sizePx, 0.5);
    for (auto _ : state) benchmark::DoNotOptimize(certifyPieces(fisheye, fitted.mesh, {}, everyOf(state)));
    reportPieces(state, fitted);
}
BENCHMARK(certifyFisheye)
    ->ArgName("every")
    ->Arg(1)
    ->Arg(8)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

void fitFisheye(benchmark::State& state) {
    const glm::ivec2 sizePx(2048);
    const LensProjection fisheye(circularLens({RadialModel::equidistant}, std::numbers::pi, sizePx), {});
    FittedPieces fitted;
    for (auto _ : state) fitted = fitPieces(fisheye, sizePx, toleranceOf(state));
    reportPieces(state, fitted);
}
BENCHMARK(fitFisheye)
    ->ArgName("tolerance_mpx")
    ->Arg(500)
    ->Arg(250)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

void findOwners(benchmark::State& state) {
    const Wall wall = test::fullCylinderWall(kSizePx);
    const FittedPieces fitted = fitPieces(*wall.displays[0].projection, kSizePx, 0.25);
    for (auto _ : state) benchmark::DoNotOptimize(ownerImage(fitted.mesh));
    reportPieces(state, fitted);
}
BENCHMARK(findOwners)->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

void buildTree(benchmark::State& state) {
    const Wall wall = test::fullCylinderWall(kSizePx);
    const FittedPieces fitted = fitPieces(*wall.displays[0].projection, kSizePx, 0.25);
    for (auto _ : state) benchmark::DoNotOptimize(buildPieceTree(fitted.mesh));
    reportPieces(state, fitted);
}
BENCHMARK(buildTree)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace curvewall
