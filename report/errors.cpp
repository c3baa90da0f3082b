#include "report/errors.h"

#include "renderer/shown_error.h"
#include "report/pixel_ranges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace curvewall {
namespace {

CoverageError coverageError(const Frame& drawn, const Frame& truth, bool isClosed) {
    const std::vector<Range> exact = rangesAround(truth, isClosed);
    CoverageError error;
    for (size_t i = 0; i < exact.size(); ++i) {
        const float count = drawn.texels[i];
        if (count == 0 && exact[i].least > 0)
            ++error.uncoveredPixels;
        else if (count > 0 && exact[i].most == 0)
            ++error.overdrawnPixels;
        else if (count > exact[i].most)
            ++error.twiceCoveredPixels;
    }
    return error;
}

bool isFinite(const Frame& frame, glm::ivec2 px) {
    const float* const texel = frame.at(px.x, px.y);
    return std::all_of(texel, texel + frame.channels, [](float number) { return std::isfinite(number); });
}

// Where nothing is drawn there is no position: all of its numbers are none.
bool isEmpty(const Frame& position, glm::ivec2 px) {
    const float* const texel = position.at(px.x, px.y);
    return std::all_of(texel, texel + position.channels, [](float number) { return std::isnan(number); });
}

// 1 where there is a position, 0 elsewhere.
Frame presenceOf(const Frame& position) {
    Frame presence{position.sizePx, 1, {}};
    for (int y = 0; y < position.sizePx.y; ++y)
        for (int x = 0; x < position.sizePx.x; ++x)
            presence.texels.push_back(isEmpty(position, {x, y}) ? 0.0f : 1.0f);
    return presence;
}

uint64_t nanTexels(const DrawnOutputs& drawn, const Frame& truePosition, bool isClosed) {
    const std::vector<Range> presence = rangesAround(presenceOf(truePosition), isClosed);
    uint64_t count = 0;
    size_t i = 0;
    for (int y = 0; y < drawn.color.sizePx.y; ++y)
        for (int x = 0; x < drawn.color.sizePx.x; ++x, ++i) {
            // What blends with what is behind it covers a pixel without having a position there.
            const bool hasPosition =
                !isEmpty(drawn.position, {x, y}) || (drawn.coverage.texels[i] > 0 && presence[i].least > 0);
            count += !isFinite(drawn.color, {x, y}) || (hasPosition && !isFinite(drawn.position, {x, y}));
        }
    return count;
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
    errors.geometric.holes -= static_cast<int>(errors.misplacedPixels);
    const bool knowsMany = !truth.supersampled.texels.empty();
    errors.image =
        compareColor(drawn.color, knowsMany && drawn.stats.samples > 1 ? truth.supersampled : truth.color);
    if (knowsMany) errors.supersampledPsnrDb = compareColor(drawn.color, truth.supersampled).psnrDb;
    const bool isClosed = closesOnItself(display);
    errors.coverage = coverageError(drawn.coverage, truth.coverage, isClosed);
    errors.nanTexels = nanTexels(drawn, truth.position, isClosed);
    return errors;
}

}  // namespace curvewall
