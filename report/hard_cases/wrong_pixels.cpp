#include "report/hard_cases/wrong_pixels.h"

#include "renderer/image_file.h"

#include <algorithm>
#include <vector>

namespace curvewall {
namespace {

std::vector<uint8_t> bytesOf(const Frame& frame) {
    std::vector<uint8_t> bytes(frame.texels.size());
    std::ranges::transform(frame.texels, bytes.begin(), srgbByteFromLinear);
    return bytes;
}

struct Range {
    int least = 255, most = 0;
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

}  // namespace

uint64_t wrongPixels(const Frame& drawn, const Frame& truth, bool isClosed) {
    constexpr int kMostOff = 8;
    const std::vector<uint8_t> shown = bytesOf(drawn), exact = bytesOf(truth);
    std::vector<Range> ranges;
    for (const uint8_t byte : exact) ranges.push_back({byte, byte});
    const auto channels = static_cast<size_t>(truth.channels), width = static_cast<size_t>(truth.sizePx.x),
               height = static_cast<size_t>(truth.sizePx.y);
    ranges = widened(ranges, channels, width, isClosed);
    ranges = widened(ranges, channels * width, height, false);
    uint64_t wrong = 0;
    for (size_t pixel = 0; pixel < width * height; ++pixel) {
        bool isWrong = false;
        for (size_t i = pixel * channels; i < (pixel + 1) * channels; ++i)
            isWrong =
                isWrong || shown[i] < ranges[i].least - kMostOff || shown[i] > ranges[i].most + kMostOff;
        wrong += isWrong;
    }
    return wrong;
}

}  // namespace curvewall
