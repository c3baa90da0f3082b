#include "report/pictures.h"

#include "calibration/errors.h"
#include "renderer/image_file.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

namespace curvewall {
namespace {

constexpr double kScaleOctaves = 4;  // to either side of the tolerance
constexpr const char* kScaleColors = "inferno";
constexpr const char* kFont = "DejaVuSans";
constexpr std::array kNowhereColor{0.216f, 0.216f, 0.216f};  // sRGB 128

void checkAlike(const Frame& drawn, const Frame& truth) {
    if (drawn.sizePx != truth.sizePx || drawn.channels != 3 || truth.channels != 3)
        throw UsageError("pictures are compared in colour and at one size");
}

int difference(const Frame& drawn, const Frame& truth, int x, int y) {
    int most = 0;
    for (int channel = 0; channel < 3; ++channel)
        most = std::max(most, std::abs(srgbByteFromLinear(drawn.at(x, y)[channel]) -
                                       srgbByteFromLinear(truth.at(x, y)[channel])));
    return most;
}

// Which pixels of a picture one of a smaller one stands for.
struct Blocks {
    Blocks(glm::ivec2 of, int widthPx)
        : fullPx(of),
          sizePx(of.x <= widthPx
                     ? of
                     : glm::ivec2{widthPx, std::max(1, static_cast<int>(int64_t{of.y} * widthPx / of.x))}) {}

    template <class Visit>
    void forEachPixel(int x, int y, Visit visit) const {
        const glm::ivec2 begin{start(x, fullPx.x, sizePx.x), start(y, fullPx.y, sizePx.y)};
        const glm::ivec2 end{start(x + 1, fullPx.x, sizePx.x), start(y + 1, fullPx.y, sizePx.y)};
        for (int row = begin.y; row < end.y; ++row)
            for (int column = begin.x; column < end.x; ++column) visit(column, row);
    }

    glm::ivec2 fullPx, sizePx;

private:
    static int start(int block, int fullPx, int blocks) {
        return static_cast<int>(int64_t{block} * fullPx / blocks);
    }
};

void setTexel(Frame& frame, int x, int y, const std::array<float, 3>& color) {
    std::copy(color.begin(), color.end(),
              &frame.texels[3 * (static_cast<size_t>(y) * static_cast<size_t>(frame.sizePx.x) +
                                 static_cast<size_t>(x))]);
}

Frame colorFrame(glm::ivec2 sizePx, float value) {
    return {sizePx, 3,
            std::vector<float>(3 * static_cast<size_t>(sizePx.x) * static_cast<size_t>(sizePx.y), value)};
}

double placeOnScale(double errorPx, double tolerancePx) {
    return std::clamp(0.5 + std::log2(errorPx / tolerancePx) / (2 * kScaleOctaves), 0.0, 1.0);
}

// In linear light, as OpenImageIO has its colour maps.
OIIO::ImageBuf scaleColored(const OIIO::ImageBuf& places) {
    OIIO::ImageBuf colors = OIIO::ImageBufAlgo::color_map(places, 0, kScaleColors);
    if (colors.has_error()) throw std::runtime_error("cannot colour a map: " + colors.geterror());
    return colors;
}

OIIO::ImageBuf scaleBar(int widthPx, int heightPx) {
    OIIO::ImageBuf places(OIIO::ImageSpec(widthPx, heightPx, 1, OIIO::TypeDesc::FLOAT));
    for (int y = 0; y < heightPx; ++y)
        for (int x = 0; x < widthPx; ++x) {
            const float place = (static_cast<float>(x) + 0.5f) / static_cast<float>(widthPx);
            places.setpixel(x, y, &place);
        }
    return scaleColored(places);
}

std::string scaleText(double place, double tolerancePx) {
    const double px = tolerancePx * std::exp2((2 * place - 1) * kScaleOctaves);
    return fmt::format("{:.2g}{}", px, place == 0.5 ? " px" : "");
}

// White with the colours in a bar and numbers below.
OIIO::ImageBuf scaleOf(int widthPx, double tolerancePx) {
    using Align = OIIO::ImageBufAlgo::TextAlignX;
    const int fontPx = std::clamp(widthPx / 22, 8, 30), barPx = fontPx;
    OIIO::ImageBuf scale(OIIO::ImageSpec(widthPx, barPx + 2 * fontPx, 3, OIIO::TypeDesc::FLOAT));
    OIIO::ImageBufAlgo::fill(scale, {1.0f, 1.0f, 1.0f});
    OIIO::ImageBufAlgo::paste(scale, 0, fontPx / 3, 0, 0, scaleBar(widthPx, barPx));
    for (const double place : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const Align align = place == 0 ? Align::Left : place == 1 ? Align::Right : Align::Center;
        const int x = static_cast<int>(std::lround(place * (widthPx - 1)));
        if (!OIIO::ImageBufAlgo::render_text(scale, x, barPx + fontPx * 3 / 2, scaleText(place, tolerancePx),
                                             fontPx, kFont, {0.0f, 0.0f, 0.0f}, align))
            throw std::runtime_error(
                "error maps need the font DejaVu Sans, of the package fonts-dejavu-core: " +
                scale.geterror());
    }
    return scale;
}

Frame below(const Frame& picture, const OIIO::ImageBuf& scale) {
    const int heightPx = scale.spec().height;
    Frame both{{picture.sizePx.x, picture.sizePx.y + heightPx}, 3, picture.texels};
    std::vector<float> texels(3 * static_cast<size_t>(picture.sizePx.x) * static_cast<size_t>(heightPx));
    scale.get_pixels(scale.roi(), OIIO::TypeDesc::FLOAT, texels.data());
    both.texels.insert(both.texels.end(), texels.begin(), texels.end());
    return both;
}

}  // namespace

Frame errorMap(const std::vector<float>& errorsPx, glm::ivec2 sizePx, double tolerancePx, int widthPx) {
    const Blocks blocks(sizePx, widthPx);
    OIIO::ImageBuf places(OIIO::ImageSpec(blocks.sizePx.x, blocks.sizePx.y, 1, OIIO::TypeDesc::FLOAT));
    std::vector<glm::ivec2> nowhere;
    for (int y = 0; y < blocks.sizePx.y; ++y)
        for (int x = 0; x < blocks.sizePx.x; ++x) {
            float worstPx = -1;
            blocks.forEachPixel(x, y, [&](int column, int row) {
                const float errorPx = errorsPx[static_cast<size_t>(row) * static_cast<size_t>(sizePx.x) +
                                               static_cast<size_t>(column)];
                if (std::isfinite(errorPx)) worstPx = std::max(worstPx, errorPx);
            });
            if (worstPx < 0) nowhere.emplace_back(x, y);
            const auto place = static_cast<float>(placeOnScale(std::max(worstPx, 0.0f), tolerancePx));
            places.setpixel(x, y, &place);
        }
    Frame map = colorFrame(blocks.sizePx, 0);
    const OIIO::ImageBuf colors = scaleColored(places);
    colors.get_pixels(colors.roi(), OIIO::TypeDesc::FLOAT, map.texels.data());
    for (const glm::ivec2 px : nowhere) setTexel(map, px.x, px.y, kNowhereColor);
    return below(map, scaleOf(map.sizePx.x, tolerancePx));
}

Frame reduced(const Frame& frame, int widthPx) {
    const Blocks blocks(frame.sizePx, widthPx);
    const auto channels = static_cast<size_t>(frame.channels);
    Frame result{blocks.sizePx, frame.channels, {}};
    for (int y = 0; y < blocks.sizePx.y; ++y)
        for (int x = 0; x < blocks.sizePx.x; ++x) {
            std::vector<float> mean(channels);
            float pixels = 0;
            blocks.forEachPixel(x, y, [&](int column, int row) {
                for (size_t channel = 0; channel < channels; ++channel)
                    mean[channel] += frame.at(column, row)[channel];
                ++pixels;
            });
            for (const float sum : mean) result.texels.push_back(sum / pixels);
        }
    return result;
}

Frame enlarged(const Frame& frame, Square square, int factor) {
    const glm::ivec2 sizePx = glm::min(glm::ivec2(square.sidePx), frame.sizePx);
    const glm::ivec2 corner = glm::clamp(square.cornerPx, glm::ivec2(0), frame.sizePx - sizePx);
    Frame result{sizePx * factor, frame.channels, {}};
    for (int y = 0; y < result.sizePx.y; ++y)
        for (int x = 0; x < result.sizePx.x; ++x) {
            const float* texel = frame.at(corner.x + x / factor, corner.y + y / factor);
            result.texels.insert(result.texels.end(), texel, texel + frame.channels);
        }
    return result;
}

void addDifference(std::vector<double>& sum, const Frame& drawn, const Frame& truth) {
    checkAlike(drawn, truth);
    sum.resize(truth.texels.size() / 3);
    for (int y = 0; y < truth.sizePx.y; ++y)
        for (int x = 0; x < truth.sizePx.x; ++x)
            sum[static_cast<size_t>(y) * static_cast<size_t>(truth.sizePx.x) + static_cast<size_t>(x)] +=
                difference(drawn, truth, x, y);
}

Square worstSquare(const std::vector<double>& sum, glm::ivec2 sizePx, int sidePx) {
    const int side = std::min({sidePx, sizePx.x, sizePx.y});
    const auto stride = static_cast<size_t>(sizePx.x) + 1;
    const auto at = [&](int x, int y) { return static_cast<size_t>(y) * stride + static_cast<size_t>(x); };
    // Of everything above and left of a corner.
    std::vector<double> sums(stride * (static_cast<size_t>(sizePx.y) + 1));
    for (int y = 0; y < sizePx.y; ++y)
        for (int x = 0; x < sizePx.x; ++x)
            sums[at(x + 1, y + 1)] =
                sum[static_cast<size_t>(y) * static_cast<size_t>(sizePx.x) + static_cast<size_t>(x)] +
                sums[at(x, y + 1)] + sums[at(x + 1, y)] - sums[at(x, y)];
    Square worst{{0, 0}, side};
    double most = -std::numeric_limits<double>::infinity();
    for (int y = 0; y + side <= sizePx.y; ++y)
        for (int x = 0; x + side <= sizePx.x; ++x) {
            const double inside =
                sums[at(x + side, y + side)] - sums[at(x, y + side)] - sums[at(x + side, y)] + sums[at(x, y)];
            if (inside > most) {
                most = inside;
                worst.cornerPx = {x, y};
            }
        }
    return worst;
}

}  // namespace curvewall
