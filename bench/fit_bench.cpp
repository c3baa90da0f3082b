// What it takes to fit and to certify the pieces of a wall. The column CPU is what one core takes for it.

#include "calibration/pieces/ownership.h"
#include "calibration/pieces/piece_refit.h"
#include "calibration/pieces/piece_tree.h"
#include "calibration/projections/lens_projection.h"
#include "calibration/projections/radial_lens.h"
#include "calibration/readers/wall_reader.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/test_walls.h"

#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <numbers>
#include <vector>

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

// The dome of five projectors, each with 1920 x 1200 pixels instead of 1280 x 800.
Wall largeDome() {
    constexpr double kTimes = 1.5;
    std::ifstream file(CURVEWALL_SOURCE_DIR "/configs/five-projector-dome.json");
    nlohmann::json wall = nlohmann::json::parse(file);
    for (nlohmann::json& display : wall["displays"]) {
        nlohmann::json& projection = display["projection"];
        for (size_t axis = 0; axis < 2; ++axis) {
            display["size"][axis] = static_cast<int>(kTimes * display["size"][axis].get<int>());
            projection["focal_px"][axis] = kTimes * projection["focal_px"][axis].get<double>();
            // Counted from the centre of the first pixel.
            projection["principal_px"][axis] =
                kTimes * (projection["principal_px"][axis].get<double>() + 0.5) - 0.5;
        }
    }
    const test::TemporaryFolder folder;
    return readWall(folder.write("dome.json", wall.dump()));
}

// Every display of a wall after the eye has moved by a centimetre; every 8th row and column, or all of them.
void refit(benchmark::State& state, const Wall& wall) {
    const Wall moved = seenFrom(wall, wall.eyeM + glm::dvec3(0.006, 0.0, 0.008));
    const int every = static_cast<int>(state.range(0));
    std::vector<FittedPieces> before, after;
    for (const Display& display : wall.displays) before.push_back(fitPieces(display, 0.25));
    if (every == 1)
        for (size_t i = 0; i < before.size(); ++i)
            before[i] = refitPieces(before[i], moved.displays[i], 0.25, kSparseRows);
    for (auto _ : state) {
        after.clear();
        for (size_t i = 0; i < before.size(); ++i)
            after.push_back(refitPieces(before[i], moved.displays[i], 0.25, every));
    }
    double pieces = 0, maxPx = 0;
    for (const FittedPieces& fitted : after) {
        pieces += static_cast<double>(fitted.mesh.pieces.size());
        maxPx = std::max(maxPx, fitted.certificate.maxPx);
    }
    state.counters["pieces"] = pieces;
    state.counters["max_error_px"] = maxPx;
}

void refitFullCylinder(benchmark::State& state) { refit(state, test::fullCylinderWall(kSizePx)); }
BENCHMARK(refitFullCylinder)
    ->MeasureProcessCPUTime()
    ->ArgName("every")
    ->Arg(kSparseRows)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond);

void refitDome(benchmark::State& state) { refit(state, largeDome()); }
BENCHMARK(refitDome)
    ->MeasureProcessCPUTime()
    ->ArgName("every")
    ->Arg(kSparseRows)
    ->Arg(1)
    ->Unit(benchmark::kMillisecond);

void buildTree(benchmark::State& state) {
    const Wall wall = test::fullCylinderWall(kSizePx);
    const FittedPieces fitted = fitPieces(*wall.displays[0].projection, kSizePx, 0.25);
    for (auto _ : state) benchmark::DoNotOptimize(buildPieceTree(fitted.mesh));
    reportPieces(state, fitted);
}
BENCHMARK(buildTree)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace curvewall
