#include "calibration/files/map_file.h"

#include "calibration/errors.h"
#include "calibration/files/exr_file.h"
#include "calibration/files/pfm_file.h"

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace curvewall {
namespace {

constexpr int kMaxChannels = 4;
// Three times as fast as zlib's default of 6, for files a few per cent larger.
constexpr int kPngCompressionLevel = 4;

}  // namespace

void requirePlausibleSize(const std::string& path, const NumberMap& map) {
    // Deflate packs a thousand bytes into one at best, and a byte of a file may become a float of four.
    constexpr uint64_t kMostPacked = 8192;
    std::error_code error;
    const uint64_t bytes = std::filesystem::file_size(path, error);
    const uint64_t numbers = static_cast<uint64_t>(map.sizePx.x) * static_cast<uint64_t>(map.sizePx.y) *
                             static_cast<uint64_t>(map.channels);
    if (error || numbers * sizeof(float) > bytes * kMostPacked)
        throw InputError(path, "",
                         "numbers of " + std::to_string(map.sizePx.x) + " x " + std::to_string(map.sizePx.y) +
                             " pixels, as its header says",
                         "a file of " + std::to_string(bytes) + " bytes");
}

NumberMap readNumberMap(const std::string& path) {
    if (isPfm(path)) return readPfm(path);
    if (auto map = readPlainExr(path)) return std::move(*map);
    const auto fail = [&path](const std::string& found) {
        return InputError(path, "", "a readable image", found);
    };
    OIIO::ImageSpec options;
    options.attribute("oiio:UnassociatedAlpha", 1);  // or colour would come multiplied by its alpha
    const auto in = OIIO::ImageInput::open(path, &options);
    if (!in) throw fail(OIIO::geterror());
    const OIIO::ImageSpec& spec = in->spec();
    if (spec.width < 1 || spec.height < 1 || spec.depth > 1 ||
        int64_t{spec.width} * spec.height > kMaxMapTexels)
        throw fail("one of " + std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels");
    if (spec.nchannels < 1 || spec.nchannels > kMaxChannels)
        throw fail("one of " + std::to_string(spec.nchannels) + " channels");

    NumberMap map{{spec.width, spec.height}, spec.nchannels, !spec.format.is_floating_point(), {}};
    requirePlausibleSize(path, map);
    map.values.resize(static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height) *
                      static_cast<size_t>(spec.nchannels));
    if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, map.values.data()))
        throw fail(in->geterror());
    return map;
}

void writePng16(const std::string& path, const NumberMap& map) {
    OIIO::ImageSpec spec(map.sizePx.x, map.sizePx.y, map.channels, OIIO::TypeDesc::UINT16);
    spec.attribute("png:compressionLevel", kPngCompressionLevel);
    const auto out = OIIO::ImageOutput::create("map.png");
    if (!out) throw std::runtime_error(path + ": " + OIIO::geterror());
    if (!out->open(path, spec) || !out->write_image(OIIO::TypeDesc::FLOAT, map.values.data()) ||
        !out->close())
        throw std::runtime_error(path + ": cannot be written: " + out->geterror());
}

}  // namespace curvewall
