#include "report/hard_cases/wrong_pixels.h"

#include "renderer/image_file.h"

#include <algorithm>
#include <vector>

namespace curvewall {
namespace {

// As the 8-bit sRGB values that a viewer gets.
std::vector<int> bytesOf(const Frame& frame) {
    std::vector<int> bytes(frame.texels.size());
    std::ranges::transform(frame.texels, bytes.begin(), srgbByteFromLinear);
    return bytes;
}

std::vector<int> countsOf(const Frame& frame) {
    std::vector<int> counts(frame.texels.size());
    std::ranges::transform(frame.texels, counts.begin(), [](float count) { return static_cast<int>(count); });
    return counts;
}

struct Range {
    int least, most;
};

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

// Of the numbers of a frame, each over its pixel and the eight around.
std::vector<Range> rangesAround(const std::vector<int>& numbers, const Frame& frame, bool isClosed) {
    std::vector<Range> ranges;
    ranges.reserve(numbers.size());
    for (const int number : numbers) ranges.push_back({number, number});
    const auto channels = static_cast<size_t>(frame.channels), width = static_cast<size_t>(frame.sizePx.x);
    ranges = widened(ranges, channels, width, isClosed);
    return widened(ranges, channels * width, static_cast<size_t>(frame.sizePx.y), false);
}

}  // namespace

uint64_t wrongPixels(const Frame& drawn, const Frame& truth, bool isClosed) {
    constexpr int kMostOff = 8;
    const std::vector<int> shown = bytesOf(drawn);
    const std::vector<Range> ranges = rangesAround(bytesOf(truth), truth, isClosed);
    const auto channels = static_cast<size_t>(truth.channels);
    uint64_t wrong = 0;
    for (size_t pixel = 0; pixel < shown.size(); pixel += channels) {
        bool isWrong = false;
        for (size_t i = pixel; i < pixel + channels; ++i)
            isWrong =
                isWrong || shown[i] < ranges[i].least - kMostOff || shown[i] > ranges[i].most + kMostOff;
        wrong += isWrong;
    }
    return wrong;
}

uint64_t gapPixels(const Frame& drawn, const Frame& truth, bool isClosed) {
    const std::vector<int> shown = countsOf(drawn);
    const std::vector<Range> ranges = rangesAround(countsOf(truth), truth, isClosed);
    uint64_t gaps = 0;
    for (size_t i = 0; i < shown.size(); ++i) gaps += shown[i] < ranges[i].least;
    return gaps;
}

}  // namespace curvewall
