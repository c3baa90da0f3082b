#include "calibration/writers/map_writer.h"

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <bit>
#include <cstddef>
#include <fstream>
#include <stdexcept>

namespace curvewall {

void writeExr(const std::string& path, const NumberMap& map) {
    OIIO::ImageSpec spec(map.sizePx.x, map.sizePx.y, map.channels, OIIO::TypeDesc::FLOAT);
    spec.channelnames = {"R", "G", "B"};
    spec.channelnames.resize(static_cast<size_t>(map.channels));
    spec.alpha_channel = -1;
    spec.attribute("compression", "zip");
    const auto out = OIIO::ImageOutput::create("map.exr");
    if (!out) throw std::runtime_error(path + ": " + OIIO::geterror());
    if (!out->open(path, spec) || !out->write_image(OIIO::TypeDesc::FLOAT, map.values.data()) ||
        !out->close())
        throw std::runtime_error(path + ": cannot be written: " + out->geterror());
}

std::string pfmBytes(const NumberMap& map) {
    static_assert(std::endian::native == std::endian::little);
    std::string bytes =
        fmt::format("{}\n{} {}\n-1.0\n", map.channels == 3 ? "PF" : "Pf", map.sizePx.x, map.sizePx.y);
    const size_t rowBytes =
        static_cast<size_t>(map.sizePx.x) * static_cast<size_t>(map.channels) * sizeof(float);
    bytes.reserve(bytes.size() + rowBytes * static_cast<size_t>(map.sizePx.y));
    for (int y = map.sizePx.y - 1; y >= 0; --y)
        bytes.append(reinterpret_cast<const char*>(map.at(0, y)), rowBytes);
    return bytes;
}

void writeBytes(const std::string& path, const std::string& bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file.flush()) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace curvewall
