// What it takes to fit and to certify the pieces of a wall.

#include "calibration/pieces/ownership.h"
#include "calibration/pieces/piece_fit.h"
#include "calibration/pieces/piece_tree.h"
#include "tests/support/test_walls.h"

#include <benchmark/benchmark.h>

namespace curvewall {
namespace {

constexpr glm::ivec2 kSizePx(1600, 1200);

double toleranceOf(const benchmark::State& state) { return static_cast<double>(state.range(0)) / 1000; }

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
    ->Unit(benchmark::kMillisecond);

void fitOffAxisCylinder(benchmark::State& state) {
    const Wall wall = test::fullCylinderWall(kSizePx, {1.8, 0, 0});
    FittedPieces fitted;
    for (auto _ : state) fitted = fitPieces(*wall.displays[0].projection, kSizePx, toleranceOf(state));
    reportPieces(state, fitted);
}
BENCHMARK(fitOffAxisCylinder)->ArgName("tolerance_mpx")->Arg(500)->Arg(250)->Unit(benchmark::kMillisecond);

void certify(benchmark::State& state) {
    const Wall wall = test::fullCylinderWall(kSizePx);
    const FittedPieces fitted = fitPieces(*wall.displays[0].projection, kSizePx, 0.25);
    for (auto _ : state) {
        const RayImage rays(*wall.displays[0].projection, kSizePx);
        const auto owners = ownerImage(fitted.mesh);
        const auto errors = pieceErrorsPx(rays, fitted.mesh, owners);
        benchmark::DoNotOptimize(certificateOf(errors, owners, kSizePx));
    }
    reportPieces(state, fitted);
}
BENCHMARK(certify)->Unit(benchmark::kMillisecond);

void buildTree(benchmark::State& state) {
    const Wall wall = test::fullCylinderWall(kSizePx);
    const FittedPieces fitted = fitPieces(*wall.displays[0].projection, kSizePx, 0.25);
    for (auto _ : state) benchmark::DoNotOptimize(buildPieceTree(fitted.mesh));
    reportPieces(state, fitted);
}
BENCHMARK(buildTree)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace curvewall
