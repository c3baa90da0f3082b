#include "renderer/image_compare.h"

#include "calibration/errors.h"
#include "renderer/image_file.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

namespace curvewall {
namespace {

constexpr int kNoticeable = 8;
constexpr int kWindowPx = 8;

std::vector<uint8_t> srgbBytes(const Frame& frame) {
    std::vector<uint8_t> bytes(frame.texels.size());
    std::transform(frame.texels.begin(), frame.texels.end(), bytes.begin(), srgbByteFromLinear);
    return bytes;
}

double luma(const uint8_t* rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

struct Moments {
    double a = 0, b = 0, aa = 0, bb = 0, ab = 0;

    Moments& operator+=(const Moments& o) {
        a += o.a, b += o.b, aa += o.aa, bb += o.bb, ab += o.ab;
        return *this;
    }
    Moments& operator-=(const Moments& o) {
        a -= o.a, b -= o.b, aa -= o.aa, bb -= o.bb, ab -= o.ab;
        return *this;
    }
};

double similarity(const Moments& sum, double count) {
    constexpr double kC1 = (0.01 * 255) * (0.01 * 255);
    constexpr double kC2 = (0.03 * 255) * (0.03 * 255);
    const double meanA = sum.a / count, meanB = sum.b / count;
    const double varianceA = sum.aa / count - meanA * meanA;
    const double varianceB = sum.bb / count - meanB * meanB;
    const double covariance = sum.ab / count - meanA * meanB;
    return (2 * meanA * meanB + kC1) * (2 * covariance + kC2) /
           ((meanA * meanA + meanB * meanB + kC1) * (varianceA + varianceB + kC2));
}

// Sums slide: down over the rows for each column, then along the row, so that the window's size is free.
double meanSimilarity(const std::vector<uint8_t>& a, const std::vector<uint8_t>& b, glm::ivec2 sizePx) {
    const glm::ivec2 window{std::min(kWindowPx, sizePx.x), std::min(kWindowPx, sizePx.y)};
    const double count = static_cast<double>(window.x) * window.y;
    const auto momentsAt = [&](int x, int y) {
        const size_t texel =
            3 * (static_cast<size_t>(y) * static_cast<size_t>(sizePx.x) + static_cast<size_t>(x));
        const double la = luma(&a[texel]), lb = luma(&b[texel]);
        return Moments{la, lb, la * la, lb * lb, la * lb};
    };

    double total = 0;
    std::vector<Moments> columns(static_cast<size_t>(sizePx.x));
    for (int y = 0; y < sizePx.y; ++y) {
        for (int x = 0; x < sizePx.x; ++x) {
            Moments& column = columns[static_cast<size_t>(x)];
            column += momentsAt(x, y);
            if (y >= window.y) column -= momentsAt(x, y - window.y);
        }
        if (y + 1 < window.y) continue;
        Moments sum;
        for (int x = 0; x < sizePx.x; ++x) {
            sum += columns[static_cast<size_t>(x)];
            if (x >= window.x) sum -= columns[static_cast<size_t>(x - window.x)];
            if (x + 1 >= window.x) total += similarity(sum, count);
        }
    }
    return total / (static_cast<double>(sizePx.x - window.x + 1) * (sizePx.y - window.y + 1));
}

void requireComparable(const Frame& a, const Frame& b) {
    const auto name = [](const Frame& f) {
        return std::to_string(f.sizePx.x) + " x " + std::to_string(f.sizePx.y) + " x " +
               std::to_string(f.channels);
    };
    if (a.sizePx != b.sizePx || a.channels != 3 || b.channels != 3 || a.texels.empty())
        throw UsageError("only colour pictures of one size can be compared, not " + name(a) + " with " +
                         name(b));
}

}  // namespace

ImageDifference compareColor(const Frame& a, const Frame& b) {
    requireComparable(a, b);
    const std::vector<uint8_t> bytesA = srgbBytes(a), bytesB = srgbBytes(b);

    ImageDifference difference;
    double squares = 0;
    size_t off = 0;
    for (size_t texel = 0; texel < bytesA.size(); texel += 3) {
        int worst = 0;
        for (size_t channel = texel; channel < texel + 3; ++channel) {
            const int delta = std::abs(int{bytesA[channel]} - int{bytesB[channel]});
            squares += static_cast<double>(delta) * delta;
            worst = std::max(worst, delta);
        }
        if (worst > kNoticeable) ++off;
        difference.maxDifference = std::max(difference.maxDifference, worst);
    }
    difference.shareOff = 3.0 * static_cast<double>(off) / static_cast<double>(bytesA.size());
    difference.psnrDb = squares == 0
                            ? std::numeric_limits<double>::infinity()
                            : 10 * std::log10(255.0 * 255.0 * static_cast<double>(bytesA.size()) / squares);
    difference.ssim = meanSimilarity(bytesA, bytesB, a.sizePx);
    return difference;
}

}  // namespace curvewall
