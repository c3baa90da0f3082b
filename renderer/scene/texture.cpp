#include "renderer/scene/texture.h"

#include "calibration/errors.h"
#include "renderer/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <memory>
#include <string_view>

namespace curvewall {
namespace {

// Colour in linear light, not multiplied by alpha: glTF's alpha mode decides what alpha means.
using LinearImage = std::vector<glm::vec4>;

LinearImage linearFromTexels(const std::vector<glm::u8vec4>& texels) {
    std::array<float, 256> linear{};
    for (size_t i = 0; i < linear.size(); ++i) linear[i] = linearFromSrgbByte(static_cast<uint8_t>(i));
    LinearImage image;
    image.reserve(texels.size());
    for (const glm::u8vec4& t : texels)
        image.emplace_back(linear[t.r], linear[t.g], linear[t.b], static_cast<float>(t.a) / 255.0f);
    return image;
}

std::vector<glm::u8vec4> texelsFromLinear(const LinearImage& image) {
    std::vector<glm::u8vec4> texels;
    texels.reserve(image.size());
    for (const glm::vec4& c : image)
        texels.emplace_back(srgbByteFromLinear(c.r), srgbByteFromLinear(c.g), srgbByteFromLinear(c.b),
                            static_cast<uint8_t>(std::lround(c.a * 255.0f)));
    return texels;
}

// One target texel covers two source texels, or, where the source size is odd, a little more than two: then
// it takes three, weighted by how much of each it covers, so that every source texel counts equally in the
// end.
struct Taps {
    int first = 0;
    std::array<float, 3> weights{};
};

Taps tapsFor(int target, int targetSize, int sourceSize) {
    if (sourceSize == 1) return {0, {1, 0, 0}};
    if (sourceSize % 2 == 0) return {2 * target, {0.5f, 0.5f, 0}};
    const auto n = static_cast<float>(sourceSize);
    return {2 * target,
            {static_cast<float>(targetSize - target) / n, static_cast<float>(targetSize) / n,
             static_cast<float>(target + 1) / n}};
}

LinearImage halved(const LinearImage& source, glm::ivec2 sourceSize, glm::ivec2 targetSize) {
    LinearImage target;
    target.reserve(static_cast<size_t>(targetSize.x) * static_cast<size_t>(targetSize.y));
    for (int y = 0; y < targetSize.y; ++y) {
        const Taps rows = tapsFor(y, targetSize.y, sourceSize.y);
        for (int x = 0; x < targetSize.x; ++x) {
            const Taps columns = tapsFor(x, targetSize.x, sourceSize.x);
            glm::vec4 sum(0);
            for (int j = 0; j < 3; ++j) {
                for (int i = 0; i < 3; ++i) {
                    const float weight =
                        rows.weights[static_cast<size_t>(j)] * columns.weights[static_cast<size_t>(i)];
                    if (weight == 0) continue;
                    sum += weight *
                           source[static_cast<size_t>(rows.first + j) * static_cast<size_t>(sourceSize.x) +
                                  static_cast<size_t>(columns.first + i)];
                }
            }
            target.push_back(sum);
        }
    }
    return target;
}

// The formats that glTF allows, recognised by their first bytes whatever the file is called.
std::string_view formatName(std::span<const uint8_t> bytes) {
    const std::string_view head(reinterpret_cast<const char*>(bytes.data()),
                                std::min<size_t>(bytes.size(), 16));
    if (head.starts_with("\x89PNG\r\n\x1a\n")) return "png";
    if (head.starts_with("\xff\xd8\xff")) return "jpeg";
    if (head.starts_with("\xabKTX")) return "a KTX image";
    if (head.starts_with("RIFF") && head.substr(std::min<size_t>(head.size(), 8)).starts_with("WEBP"))
        return "a WebP image";
    if (head.starts_with("DDS ")) return "a DDS image";
    if (head.starts_with("GIF8")) return "a GIF image";
    if (head.starts_with("BM")) return "a BMP image";
    return "unknown bytes";
}

}  // namespace

Texture makeTexture(std::string name, glm::ivec2 sizePx, std::vector<glm::u8vec4> texels, Wrap wrapS,
                    Wrap wrapT) {
    assert(sizePx.x > 0 && sizePx.y > 0);
    assert(texels.size() == static_cast<size_t>(sizePx.x) * static_cast<size_t>(sizePx.y));
    LinearImage linear = linearFromTexels(texels);
    Texture texture{std::move(name), wrapS, wrapT, {}};
    texture.levels.push_back({sizePx, std::move(texels)});
    while (sizePx.x > 1 || sizePx.y > 1) {
        const glm::ivec2 half = glm::max(sizePx / 2, glm::ivec2(1));
        linear = halved(linear, sizePx, half);
        texture.levels.push_back({half, texelsFromLinear(linear)});
        sizePx = half;
    }
    return texture;
}

MipLevel decodeImage(const std::string& file, const std::string& field, std::span<const uint8_t> bytes) {
    const std::string_view format = formatName(bytes);
    if (format != "png" && format != "jpeg")
        throw InputError(file, field, "a PNG or JPEG image", std::string(format));

    OIIO::Filesystem::IOMemReader reader(const_cast<uint8_t*>(bytes.data()), bytes.size());
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;
    OIIO::Filesystem::IOProxy* proxy = &reader;
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    const auto input = OIIO::ImageInput::open("texture." + std::string(format), &config);
    if (!input) throw InputError(file, field, "a readable image", OIIO::geterror());

    const OIIO::ImageSpec spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.width > kMaxTextureSizePx ||
        spec.height > kMaxTextureSizePx)
        throw InputError(file, field,
                         "an image of at most " + std::to_string(kMaxTextureSizePx) + " pixels a side",
                         std::to_string(spec.width) + " x " + std::to_string(spec.height));
    if (spec.nchannels < 1 || spec.nchannels > 4)
        throw InputError(file, field, "1 to 4 channels", std::to_string(spec.nchannels));

    const auto channels = static_cast<size_t>(spec.nchannels);
    const size_t pixels = static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height);
    std::vector<uint8_t> data(pixels * channels);
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, data.data()))
        throw InputError(file, field, "a readable image", input->geterror());

    MipLevel image{{spec.width, spec.height}, {}};
    image.texels.reserve(pixels);
    for (size_t i = 0; i < pixels; ++i) {
        const uint8_t* c = data.data() + i * channels;
        const bool grey = channels < 3;
        const uint8_t alpha = channels == 2 ? c[1] : channels == 4 ? c[3] : uint8_t{255};
        image.texels.emplace_back(c[0], grey ? c[0] : c[1], grey ? c[0] : c[2], alpha);
    }
    return image;
}

}  // namespace curvewall
