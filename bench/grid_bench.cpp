// What measured maps cost: reading one, and a ray for a pixel.

#include "calibration/files/json_file.h"
#include "calibration/projections/camera_texture.h"
#include "calibration/projections/frustum.h"
#include "calibration/projections/surface_map.h"
#include "calibration/readers/grid_reader.h"
#include "tests/support/random_numbers.h"
#include "tests/support/temporary_folder.h"

#include <OpenImageIO/imageio.h>
#include <benchmark/benchmark.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace curvewall {
namespace {

constexpr int kNodes = 4096;
constexpr glm::ivec2 kNodesPx(kNodes, kNodes);

// A lens's kind of offset, in pixels.
glm::vec2 offsetAt(int x, int y) {
    const glm::dvec2 p = 2.0 * (glm::dvec2(x, y) + 0.5) / static_cast<double>(kNodes) - 1.0;
    return glm::vec2(-60.0 * p * glm::dot(p, p) + 5.0 * glm::sin(9.0 * glm::dvec2(p.y, p.x)));
}

struct Format {
    const char* file;
    const char* compression;
    int channels;
    OIIO::TypeDesc type;
};
const Format kFormats[]{
    {"map.pfm", "none", 3, OIIO::TypeDesc::FLOAT},  {"plain.exr", "none", 2, OIIO::TypeDesc::FLOAT},
    {"zip.exr", "zip", 2, OIIO::TypeDesc::FLOAT},   {"half.exr", "zip", 2, OIIO::TypeDesc::HALF},
    {"map.png", "none", 3, OIIO::TypeDesc::UINT16},
};

std::vector<float> numbersFor(const Format& format) {
    const bool integer = format.type == OIIO::TypeDesc::UINT16;
    std::vector<float> numbers;
    for (int y = 0; y < kNodes; ++y)
        for (int x = 0; x < kNodes; ++x) {
            const glm::vec2 offset = integer ? offsetAt(x, y) / 512.0f + 0.5f : offsetAt(x, y);
            numbers.insert(numbers.end(), {offset.x, offset.y});
            if (format.channels == 3) numbers.push_back(0);
        }
    return numbers;
}

void write(const test::TemporaryFolder& folder, const Format& format) {
    const std::vector<float> numbers = numbersFor(format);
    if (format.file == std::string("map.pfm")) {
        std::string text = "PF\n4096 4096\n-1.0\n";
        text.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float));
        folder.write(format.file, text);
        return;
    }
    OIIO::ImageSpec spec(kNodes, kNodes, format.channels, format.type);
    spec.attribute("compression", format.compression);
    const auto out = OIIO::ImageOutput::create(format.file);
    out->open(folder.path(format.file), spec);
    out->write_image(OIIO::TypeDesc::FLOAT, numbers.data());
    out->close();
}

void readCameraTextureFile(benchmark::State& state) {
    const Format& format = kFormats[state.range(0)];
    const test::TemporaryFolder folder;
    write(folder, format);
    const nlohmann::json object{
        {"offsets", format.file},
        {"direction", "forward"},
        {"semantics", "offset"},
        {"alignment", "centers"},
        {"origin", "top_left"},
        {"units", "px"},
        {"scale", format.type == OIIO::TypeDesc::UINT16 ? 512 : 1},
        {"base", {{"left_deg", -45}, {"right_deg", 45}, {"down_deg", -45}, {"up_deg", 45}}}};
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    for (auto _ : state) {
        JsonFields fields(object, "projection");
        std::vector<std::string> files;
        benchmark::DoNotOptimize(readCameraTexture(fields, {{folder.path(), files}, {}, kNodesPx}));
    }
    state.SetLabel(std::string(format.file) + (format.channels == 3 ? ", 3 channels" : ", 2 channels"));
    state.counters["ms_per_Mpx"] =
        benchmark::Counter(kNodes / 1024.0 * kNodes / 1024.0,
                           benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(readCameraTextureFile)->DenseRange(0, 4)->Unit(benchmark::kMillisecond);

CameraTexture cameraTexture(MapDirection direction) {
    NumberMap numbers{kNodesPx, 3, false, numbersFor(kFormats[0])};
    return {std::make_shared<GridMap>(std::move(numbers), NodeMeaning{.isOffset = true}, kNodesPx,
                                      Alignment::centers),
            std::make_shared<FrustumProjection>(Frustum{-0.7, 0.7, -0.7, 0.7, {}}, kNodesPx), direction};
}

void buildMap(benchmark::State& state) {
    const NumberMap numbers{kNodesPx, 3, false, numbersFor(kFormats[0])};
    for (auto _ : state) {
        state.PauseTiming();
        NumberMap copy = numbers;
        state.ResumeTiming();
        benchmark::DoNotOptimize(
            GridMap(std::move(copy), NodeMeaning{.isOffset = true}, kNodesPx, Alignment::centers));
    }
}
BENCHMARK(buildMap)->Unit(benchmark::kMillisecond);

// Row by row as the fitter and the certificate do, or anywhere.
void unprojectPixels(benchmark::State& state, const Projection& projection, bool inOrder) {
    test::Random random(1);
    std::vector<glm::dvec2> pixels;
    for (int i = 0; i < 1 << 20; ++i)
        pixels.push_back(inOrder ? glm::dvec2(i % kNodes + 0.5, 1000.5 + i / kNodes)
                                 : random.pixel(kNodesPx));
    size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(projection.unproject(pixels[i++ % pixels.size()]));
}

void unprojectForward(benchmark::State& state) {
    static const CameraTexture kTexture = cameraTexture(MapDirection::forward);
    unprojectPixels(state, kTexture, state.range(0) != 0);
}
BENCHMARK(unprojectForward)->ArgName("in_order")->Arg(1)->Arg(0);

void unprojectInverse(benchmark::State& state) {
    static const CameraTexture kTexture = cameraTexture(MapDirection::inverse);
    unprojectPixels(state, kTexture, state.range(0) != 0);
}
BENCHMARK(unprojectInverse)->ArgName("in_order")->Arg(1)->Arg(0);

std::shared_ptr<const MeasuredSurface> measuredCylinder() {
    NumberMap points{kNodesPx, 3, false, {}};
    for (int y = 0; y < kNodes; ++y)
        for (int x = 0; x < kNodes; ++x) {
            const double angle = 2.0 * (x + 0.5) / kNodes - 1;
            points.values.insert(points.values.end(), {static_cast<float>(3 * std::sin(angle)),
                                                       static_cast<float>(1.5 - 3 * (y + 0.5) / kNodes),
                                                       static_cast<float>(-3 * std::cos(angle))});
        }
    return std::make_shared<const MeasuredSurface>(std::move(points), false, kNodesPx, Alignment::centers);
}

void projectOntoSurface(benchmark::State& state) {
    static const SurfaceMap kSurface(measuredCylinder(), 1, {}, {0.4, 0.1, 0.3});
    test::Random random(2);
    std::vector<glm::dvec3> rays;
    for (int i = 0; i < 1 << 18; ++i) rays.push_back(*kSurface.unproject(random.pixel(kNodesPx)));
    size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(kSurface.project(rays[i++ % rays.size()]));
}
BENCHMARK(projectOntoSurface);

void moveTheEyeBeforeASurface(benchmark::State& state) {
    static const SurfaceMap kSurface(measuredCylinder(), 1, {}, {0.4, 0.1, 0.3});
    for (auto _ : state) benchmark::DoNotOptimize(kSurface.seenFrom({0.1, 0.2, 0.3}));
}
BENCHMARK(moveTheEyeBeforeASurface);

}  // namespace
}  // namespace curvewall
