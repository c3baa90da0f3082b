#include "report/hard_cases/wrong_pixels.h"

#include "renderer/image_file.h"
#include "report/pixel_ranges.h"

#include <algorithm>
#include <vector>

namespace curvewall {
namespace {

// In the 8-bit sRGB values that a viewer gets.
Frame inBytes(Frame frame) {
    std::ranges::transform(frame.texels, frame.texels.begin(),
                           [](float linear) { return static_cast<float>(srgbByteFromLinear(linear)); });
    return frame;
}

}  // namespace

uint64_t wrongPixels(const Frame& drawn, const Frame& truth, bool isClosed) {
    constexpr float kMostOff = 8;
    const Frame shown = inBytes(drawn);
    const std::vector<Range> ranges = rangesAround(inBytes(truth), isClosed);
    const auto channels = static_cast<size_t>(truth.channels);
    uint64_t wrong = 0;
    for (size_t pixel = 0; pixel < ranges.size(); pixel += channels) {
        bool isWrong = false;
        for (size_t i = pixel; i < pixel + channels; ++i)
            isWrong = isWrong || shown.texels[i] < ranges[i].least - kMostOff ||
                      shown.texels[i] > ranges[i].most + kMostOff;
        wrong += isWrong;
    }
    return wrong;
}

uint64_t gapPixels(const Frame& drawn, const Frame& truth, bool isClosed) {
    const std::vector<Range> ranges = rangesAround(truth, isClosed);
    uint64_t gaps = 0;
    for (size_t i = 0; i < ranges.size(); ++i) gaps += drawn.texels[i] < ranges[i].least;
    return gaps;
}

}  // namespace curvewall
