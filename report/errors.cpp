#include "report/errors.h"

#include "renderer/shown_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace curvewall {
namespace {

struct Range {
    float least, most;
};

// Of a one-channel picture, over a pixel and those around it.
Range rangeAround(const Frame& frame, glm::ivec2 px) {
    Range range{std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
    for (int y = std::max(px.y - 1, 0); y <= std::min(px.y + 1, frame.sizePx.y - 1); ++y)
        for (int x = std::max(px.x - 1, 0); x <= std::min(px.x + 1, frame.sizePx.x - 1); ++x) {
            range.least = std::min(range.least, *frame.at(x, y));
            range.most = std::max(range.most, *frame.at(x, y));
        }
    return range;
}

CoverageError coverageError(const Frame& drawn, const Frame& truth) {
    CoverageError error;
    for (int y = 0; y < drawn.sizePx.y; ++y)
        for (int x = 0; x < drawn.sizePx.x; ++x) {
            const float count = *drawn.at(x, y);
            const Range exact = rangeAround(truth, {x, y});
            if (count == 0 && exact.least > 0)
                ++error.uncoveredPixels;
            else if (count > 0 && exact.most == 0)
                ++error.overdrawnPixels;
            else if (count > exact.most)
                ++error.twiceCoveredPixels;
        }
    return error;
}

}  // namespace

DrawnOutputs drawOutputs(Renderer& renderer, RenderRequest request) {
    request.output = OutputKind::color;
    RenderResult color = renderer.render(request);
    DrawnOutputs drawn{std::move(color.frame), {}, {}, std::move(color.stats)};
    request.samples = request.frames = 1;
    request.measuresError = request.timesStages = false;
    request.output = OutputKind::position;
    drawn.position = renderer.render(request).frame;
    request.output = OutputKind::coverage;
    drawn.coverage = renderer.render(request).frame;
    return drawn;
}

MethodErrors errorsOf(const DrawnOutputs& drawn, const Truth& truth, const Display& display) {
    MethodErrors errors;
    std::vector<float> errorsPx = shownErrorsPx(drawn.position, display);
    for (float& error : errorsPx)
        if (std::isinf(error)) {
            ++errors.misplacedPixels;
            error = std::numeric_limits<float>::quiet_NaN();
        }
    const std::vector<int32_t> owners(errorsPx.size(), 0);
    errors.geometric = certificateOf(errorsPx, owners, drawn.position.sizePx);
    const bool knowsMany = !truth.supersampled.texels.empty();
    errors.image =
        compareColor(drawn.color, knowsMany && drawn.stats.samples > 1 ? truth.supersampled : truth.color);
    if (knowsMany) errors.supersampledPsnrDb = compareColor(drawn.color, truth.supersampled).psnrDb;
    errors.coverage = coverageError(drawn.coverage, truth.coverage);
    errors.nanTexels = static_cast<uint64_t>(
        std::ranges::count_if(drawn.color.texels, [](float v) { return std::isnan(v); }));
    return errors;
}

}  // namespace curvewall
