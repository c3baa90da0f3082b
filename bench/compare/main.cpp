// Speed against error of piecewise and image-based on the displays of the wall files given, as CSV, in a city
// of flat colours. Run it on an otherwise idle machine.

#include "bench/compare/flat_city.h"
#include "bench/compare/settings.h"
#include "calibration/errors.h"
#include "calibration/readers/wall_reader.h"
#include "renderer/gl/egl_context.h"
#include "renderer/image_compare.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <exception>
#include <iostream>

namespace curvewall {
namespace {

constexpr int kFrames = 12;
constexpr int kManyRays = 64;

std::vector<int> hardwareSamples() {
    const EglContext context;
    GLint most = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    std::vector<int> samples{1};
    for (const int count : {4, 8})
        if (count <= most) samples.push_back(count);
    return samples;
}

// What the exact projection shows at pixel centres, and over whole pixels.
struct Truth {
    Frame centres, pixels;
};

Truth truthOf(Renderer& renderer, RenderRequest request) {
    request.method = Method::reference;
    Truth truth;
    truth.centres = renderer.render(request).frame;
    request.samples = kManyRays;
    truth.pixels = renderer.render(request).frame;
    return truth;
}

void printRow(const RenderRequest& request, const Display& display, const RenderResult& result,
              const Truth& truth) {
    const RenderStats& stats = result.stats;
    const ImageDifference centres = compareColor(result.frame, truth.centres);
    std::cout << display.name << ',' << settingAsCsv(request) << ',' << stats.faceSizePx << ','
              << std::max(stats.pieces, stats.faces) << ',' << stats.geometricError.maxPx << ','
              << stats.frameMsMedian << ',' << stats.prepareMs << ',' << centres.shareOff << ','
              << centres.psnrDb << ',' << compareColor(result.frame, truth.pixels).psnrDb << std::endl;
}

void compareOn(const WallPtr& wall, const Display& display, const ScenePtr& scene,
               const std::vector<int>& sampleCounts) {
    RenderRequest base;
    base.wall = wall;
    base.display = display.name;
    base.scene = scene;
    base.camera = scene->defaultCamera;
    base.style = Style::unlit;
    Renderer renderer;
    const Truth truth = truthOf(renderer, base);
    base.frames = kFrames;
    for (const int samples : sampleCounts) {
        for (const RenderRequest& request : settingsFor(base, samples)) {
            try {
                printRow(request, display, renderer.render(request), truth);
            } catch (const UsageError&) {
                // No plane holds this display.
            }
        }
    }
}

void compare(const std::vector<std::string>& wallFiles) {
    const ScenePtr city = makeFlatCity();
    const std::vector<int> samples = hardwareSamples();
    std::cout << "display,method,source,filter,tolerance_px,samples,face_px,pictures,max_error_px,frame_ms,"
                 "prepare_ms,wrong_share,psnr_db,supersampled_psnr_db\n";
    for (const std::string& file : wallFiles) {
        const auto wall = std::make_shared<const Wall>(readWall(file));
        for (const Display& display : wall->displays) compareOn(wall, display, city, samples);
    }
}

}  // namespace
}  // namespace curvewall

int main(int argc, char** argv) {
    try {
        curvewall::compare({argv + 1, argv + argc});
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
