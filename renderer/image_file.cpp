#include "renderer/image_file.h"

#include "calibration/errors.h"
#include "calibration/files/map_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

namespace curvewall {
namespace {

constexpr int kJpegQuality = 95;
// Three times as fast as zlib's default of 6, for files a few per cent larger.
constexpr int kPngCompressionLevel = 4;

double linearFromSrgb(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

// Exact where the formula in float is not, and ten times as fast.
class SrgbEncoder {
public:
    SrgbEncoder() {
        for (size_t i = 0; i + 1 < thresholds_.size(); ++i)
            thresholds_[i] = linearFromSrgb((static_cast<double>(i) + 0.5) / 255.0);
        thresholds_.back() = std::numeric_limits<double>::infinity();
        for (size_t i = 0; i < starts_.size(); ++i)
            starts_[i] = static_cast<uint8_t>(
                std::upper_bound(thresholds_.begin(), thresholds_.end(), static_cast<double>(i) / kBins) -
                thresholds_.begin());
    }

    uint8_t operator()(float linear) const {
        if (!(linear > 0)) return 0;  // NaN is not
        if (linear >= 1) return 255;
        uint8_t byte = starts_[static_cast<size_t>(linear * kBins)];
        while (thresholds_[byte] <= linear) ++byte;
        return byte;
    }

private:
    static constexpr int kBins = 4096;      // about one for each step of the darkest bytes
    std::array<double, 256> thresholds_{};  // the light at which the next byte begins
    std::array<uint8_t, kBins> starts_{};   // the byte of a bin's least light
};

const char* formatName(ImageFormat format) {
    switch (format) {
        case ImageFormat::png:
            return "png";
        case ImageFormat::jpeg:
            return "jpeg";
        case ImageFormat::exr:
            return "exr";
    }
    return "";
}

std::vector<std::string> channelNames(OutputKind output, int channels) {
    switch (output) {
        case OutputKind::color:
            if (channels == 1) return {"Y"};
            return {"R", "G", "B"};
        case OutputKind::depth:
            return {"Z"};
        case OutputKind::coverage:
            return {"coverage"};
        case OutputKind::position:
            return {"X", "Y", "Z"};
    }
    return {};
}

OIIO::ImageSpec floatSpec(const Frame& frame, OutputKind output) {
    OIIO::ImageSpec spec(frame.sizePx.x, frame.sizePx.y, frame.channels, OIIO::TypeDesc::FLOAT);
    spec.channelnames = channelNames(output, frame.channels);
    if (static_cast<int>(spec.channelnames.size()) != frame.channels)
        throw std::invalid_argument("a frame of " + std::to_string(frame.channels) +
                                    " channels does not fit its kind of output");
    spec.attribute("compression", "zip");
    // OpenImageIO writes the time of day unless there is a date already; the same frame must give the same
    // bytes.
    spec.attribute("DateTime", "");
    return spec;
}

OIIO::ImageSpec byteSpec(const Frame& frame, ImageFormat format, OutputKind output) {
    if (output != OutputKind::color || frame.channels != 3)
        throw UsageError(std::string("a ") + formatName(format) +
                         " file holds 8-bit colour only; depth, coverage and position need .exr");
    OIIO::ImageSpec spec(frame.sizePx.x, frame.sizePx.y, frame.channels, OIIO::TypeDesc::UINT8);
    if (format == ImageFormat::png) spec.attribute("png:compressionLevel", kPngCompressionLevel);
    if (format == ImageFormat::jpeg) {
        spec.attribute("Compression", "jpeg:" + std::to_string(kJpegQuality));
        spec.attribute("jpeg:subsampling", "4:4:4");
    }
    return spec;
}

std::vector<uint8_t> srgbBytes(const Frame& frame) {
    std::vector<uint8_t> bytes(frame.texels.size());
    std::transform(frame.texels.begin(), frame.texels.end(), bytes.begin(), srgbByteFromLinear);
    return bytes;
}

}  // namespace

ImageFormat imageFormatFromPath(std::string_view path) {
    const size_t dot = path.find_last_of("./");
    std::string extension(dot == std::string_view::npos ? "" : path.substr(dot));
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".png") return ImageFormat::png;
    if (extension == ".jpg" || extension == ".jpeg") return ImageFormat::jpeg;
    if (extension == ".exr") return ImageFormat::exr;
    throw UsageError(std::string(path) + ": expected a file name that ends in .png, .jpg, .jpeg or .exr");
}

std::vector<uint8_t> encodeFrame(const Frame& frame, ImageFormat format, OutputKind output) {
    const bool isFloat = format == ImageFormat::exr;
    const OIIO::ImageSpec spec = isFloat ? floatSpec(frame, output) : byteSpec(frame, format, output);

    const auto fail = [](const std::string& error) {
        return std::runtime_error("cannot encode the image: " + error);
    };
    std::vector<uint8_t> file;
    OIIO::Filesystem::IOVecOutput sink(file);
    const std::string name = std::string("frame.") + formatName(format);
    const auto out = OIIO::ImageOutput::create(name);
    if (!out) throw fail(OIIO::geterror());
    if (!out->set_ioproxy(&sink) || !out->open(name, spec)) throw fail(out->geterror());
    const std::vector<uint8_t> bytes = isFloat ? std::vector<uint8_t>() : srgbBytes(frame);
    const void* texels = isFloat ? static_cast<const void*>(frame.texels.data()) : bytes.data();
    if (!out->write_image(isFloat ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8, texels) || !out->close())
        throw fail(out->geterror());
    return file;
}

void writeFrame(const std::string& path, const Frame& frame, OutputKind output) {
    const std::vector<uint8_t> bytes = encodeFrame(frame, imageFormatFromPath(path), output);
    errno = 0;
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) throw std::runtime_error(path + ": cannot be written: " + std::strerror(errno));
}

Frame readFrame(const std::string& path) {
    NumberMap map = readNumberMap(path);
    Frame frame{map.sizePx, map.channels >= 3 ? 3 : 1, {}};
    if (frame.channels == map.channels) {
        frame.texels = std::move(map.values);
    } else {
        frame.texels.reserve(map.values.size());
        for (size_t i = 0; i < map.values.size(); ++i)
            if (static_cast<int>(i % static_cast<size_t>(map.channels)) < frame.channels)
                frame.texels.push_back(map.values[i]);
    }
    if (map.isInteger)
        for (float& texel : frame.texels) texel = static_cast<float>(linearFromSrgb(texel));
    return frame;
}

uint8_t srgbByteFromLinear(float linear) {
    static const SrgbEncoder kEncoder;
    return kEncoder(linear);
}

float linearFromSrgbByte(uint8_t byte) {
    static const std::array<float, 256> kLinear = [] {
        std::array<float, 256> linear{};
        for (size_t i = 0; i < linear.size(); ++i)
            linear[i] = static_cast<float>(linearFromSrgb(static_cast<double>(i) / 255.0));
        return linear;
    }();
    return kLinear[byte];
}

}  // namespace curvewall
