// Speed against error of piecewise and image-based on the displays of the wall files given, as CSV, in a city
// of flat colours. Run it on an otherwise idle machine.

#include "bench/compare/flat_city.h"
#include "bench/compare/settings.h"
#include "bench/request.h"
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

constexpr int kManyRays = 64;

// How many samples, and how many frames are worth their time.
struct Sampling {
    int samples, frames;
};

// One a pixel, as many as the driver has, and passes beyond that.
std::vector<Sampling> samplings() {
    const EglContext context;
    GLint most = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    std::vector<Sampling> samplings{{1, 12}};
    for (const int samples : {4, 8})
        if (samples <= most) samplings.push_back({samples, 4});
    samplings.push_back({16, 2});
    return samplings;
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
               const std::vector<Sampling>& samplings) {
    RenderRequest base = requestFor(wall, scene);
    base.display = display.name;
    base.style = Style::unlit;
    Renderer renderer;
    const Truth truth = truthOf(renderer, base);
    for (const Sampling& sampling : samplings) {
        base.samples = sampling.samples;
        base.frames = sampling.frames;
        for (const RenderRequest& request : settingsFor(base)) {
            // Nearest is of no use for averages, and large pictures drawn many times over take minutes.
            const bool isNearest = request.filter == SourceFilter::nearest;
            if (sampling.samples > 1 && isNearest) continue;
            if (sampling.samples > 4 && request.faceSizePx > 2048) continue;
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
    const std::vector<Sampling> all = samplings();
    std::cout << "display,method,source,filter,tolerance_px,samples,face_px,pictures,max_error_px,frame_ms,"
                 "prepare_ms,wrong_share,psnr_db,supersampled_psnr_db\n";
    for (const std::string& file : wallFiles) {
        const auto wall = std::make_shared<const Wall>(readWall(file));
        for (const Display& display : wall->displays) compareOn(wall, display, city, all);
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
