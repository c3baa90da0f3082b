#include "report/pixel_ranges.h"

#include <algorithm>

namespace curvewall {
namespace {

// Of every number and those beside it: `step` on in a line of `length`, which may close on itself.
std::vector<Range> widened(const std::vector<Range>& ranges, size_t step, size_t length, bool isClosed) {
    std::vector<Range> wide = ranges;
    for (size_t i = 0; i < ranges.size(); ++i) {
        const size_t place = i / step % length, start = i - place * step;
        const auto take = [&](size_t other) {
            const Range& beside = ranges[start + other * step];
            wide[i] = {std::min(wide[i].least, beside.least), std::max(wide[i].most, beside.most)};
        };
        if (place > 0 || isClosed) take((place + length - 1) % length);
        if (place + 1 < length || isClosed) take((place + 1) % length);
    }
    return wide;
}

}  // namespace

std::vector<Range> rangesAround(const Frame& frame, bool isClosed) {
    std::vector<Range> ranges;
    ranges.reserve(frame.texels.size());
    for (const float number : frame.texels) ranges.push_back({number, number});
    const auto channels = static_cast<size_t>(frame.channels), width = static_cast<size_t>(frame.sizePx.x);
    ranges = widened(ranges, channels, width, isClosed);
    return widened(ranges, channels * width, static_cast<size_t>(frame.sizePx.y), false);
}

}  // namespace curvewall
