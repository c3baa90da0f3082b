#include "calibration/files/map_file.h"

#include "calibration/errors.h"
#include "calibration/files/exr_file.h"
#include "calibration/files/pfm_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

namespace curvewall {
namespace {

// Three times as fast as zlib's default of 6, for files a few per cent larger.
constexpr int kPngCompressionLevel = 4;

constexpr std::string_view kExrStart("\x76\x2f\x31\x01", 4);

struct Picture {
    std::string_view start;
    const char* format;  // as OpenImageIO calls it
};

constexpr std::array<Picture, 5> kPictures{{
    {"\x89PNG\r\n", "png"},
    {{"II*\0", 4}, "tiff"},
    {{"MM\0*", 4}, "tiff"},
    {"\xff\xd8\xff", "jpeg"},
    {"BM", "bmp"},
}};

const Picture* pictureOf(std::string_view bytes) {
    const auto found =
        std::ranges::find_if(kPictures, [bytes](const Picture& p) { return bytes.starts_with(p.start); });
    return found == kPictures.end() ? nullptr : &*found;
}

bool isExrFile(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::array<char, kExrStart.size()> start{};
    return in.read(start.data(), start.size()) && isExr({start.data(), start.size()});
}

// Or colour would come multiplied by its alpha.
OIIO::ImageSpec asStored() {
    OIIO::ImageSpec options;
    options.attribute("oiio:UnassociatedAlpha", 1);
    return options;
}

NumberMap readPixels(OIIO::ImageInput& in, const std::string& path, uint64_t fileBytes,
                     const AllowSize& allow = {}) {
    const OIIO::ImageSpec& spec = in.spec();
    if (spec.depth > 1)
        throw InputError(path, "", "a flat image", "one of " + std::to_string(spec.depth) + " layers");
    NumberMap map{mapSizePx(path, spec.width, spec.height, spec.nchannels),
                  spec.nchannels,
                  !spec.format.is_floating_point(),
                  {}};
    requirePlausibleSize(path, fileBytes, map);
    if (allow) allow(map.sizePx);
    map.values.resize(static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height) *
                      static_cast<size_t>(spec.nchannels));
    if (!in.read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, map.values.data()))
        throw InputError(path, "", "a readable image", in.geterror());
    return map;
}

}  // namespace

glm::ivec2 mapSizePx(const std::string& path, int64_t width, int64_t height, int channels) {
    if (width < 1 || height < 1 || width > kMaxMapSidePx || height > kMaxMapSidePx ||
        width * height > kMaxMapTexels)
        throw InputError(path, "", "a readable image",
                         "one of " + std::to_string(width) + " x " + std::to_string(height) + " pixels");
    if (channels < 1 || channels > kMaxMapChannels)
        throw InputError(path, "", "a readable image", "one of " + std::to_string(channels) + " channels");
    return {static_cast<int>(width), static_cast<int>(height)};
}

void requirePlausibleSize(const std::string& path, uint64_t fileBytes, const NumberMap& map) {
    // Deflate packs a thousand bytes into one at best, and a byte of a file may become a float of four.
    constexpr uint64_t kMostPacked = 8192;
    const uint64_t numbers = static_cast<uint64_t>(map.sizePx.x) * static_cast<uint64_t>(map.sizePx.y) *
                             static_cast<uint64_t>(map.channels);
    if (numbers * sizeof(float) > fileBytes * kMostPacked)
        throw InputError(path, "",
                         "numbers of " + std::to_string(map.sizePx.x) + " x " + std::to_string(map.sizePx.y) +
                             " pixels, as its header says",
                         "a file of " + std::to_string(fileBytes) + " bytes");
}

NumberMap readNumberMap(const std::string& path) {
    if (isPfmFile(path)) return readPfm(path);
    if (isExrFile(path)) return readExr(path);
    const OIIO::ImageSpec options = asStored();
    const auto in = OIIO::ImageInput::open(path, &options);
    if (!in) throw InputError(path, "", "a readable image", OIIO::geterror());
    std::error_code error;
    const uint64_t bytes = std::filesystem::file_size(path, error);
    return readPixels(*in, path, error ? 0 : bytes);
}

NumberMap readNumberMap(const FileBytes& file, const AllowSize& allow) {
    if (isPfm(file.bytes)) return parsePfm(file, allow);
    if (isExr(file.bytes)) return readExr(file, allow);
    const Picture* picture = pictureOf(file.bytes);
    if (!picture)
        throw InputError(file.path, "", "a PFM, EXR, PNG, TIFF, JPEG or BMP",
                         "a file that begins like none of them");
    OIIO::Filesystem::IOMemReader reader(const_cast<char*>(file.bytes.data()), file.bytes.size());
    OIIO::ImageSpec options = asStored();
    // The PNG reader looks for it only here.
    OIIO::Filesystem::IOProxy* proxy = &reader;
    options.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    // Not the name of the file, which might call for a reader of another format.
    const auto in = OIIO::ImageInput::create(picture->format);
    OIIO::ImageSpec spec;
    if (!in || !in->set_ioproxy(&reader) || !in->open(file.path, spec, options))
        throw InputError(file.path, "", "a readable image", in ? in->geterror() : OIIO::geterror());
    return readPixels(*in, file.path, file.bytes.size(), allow);
}

bool isPicture(std::string_view bytes) { return isExr(bytes) || pictureOf(bytes); }

bool isExr(std::string_view bytes) { return bytes.starts_with(kExrStart); }

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
