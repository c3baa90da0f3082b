#include "calibration/formats/vioso_blocks.h"

#include "calibration/errors.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

namespace curvewall {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are read as they lie in the file");

constexpr std::string_view kSetStart = "vwf1";
constexpr uint64_t kSetHeader = 16, kLeastHeader = 28, kMostHeader = uint64_t{1} << 20;
constexpr uint64_t kMostSide = 16384;
constexpr uint64_t kMostBlocks = 4096;

// The part of the bytes that a block still has; every read is checked against it.
class Reader {
public:
    explicit Reader(const FileBytes& file) : file_(file) {}

    uint64_t at() const { return at_; }
    void jump(uint64_t at) { at_ = at; }
    bool isAtEnd() const { return at_ >= file_.bytes.size(); }
    bool startsWith(std::string_view start) const {
        return !isAtEnd() && std::string_view(file_.bytes).substr(at_).starts_with(start);
    }

    // The next bytes; `what` is for the message.
    std::string_view take(uint64_t count, const std::string& what) {
        const uint64_t left = isAtEnd() ? 0 : file_.bytes.size() - at_;
        if (count > left)
            throw InputError(file_.path, what + " at byte " + std::to_string(at_),
                             std::to_string(count) + " bytes", std::to_string(left));
        const std::string_view taken = std::string_view(file_.bytes).substr(at_, count);
        at_ += count;
        return taken;
    }

private:
    const FileBytes& file_;
    uint64_t at_ = 0;
};

// Zero where a shorter header ends before.
template <class Number>
Number numberAt(std::string_view bytes, uint64_t offset) {
    Number number{};
    if (offset + sizeof number <= bytes.size()) std::memcpy(&number, bytes.data() + offset, sizeof number);
    return number;
}

bool isWarp(const Reader& in) {
    return in.startsWith("vwf0") || in.startsWith("vwf2") || in.startsWith("vwf3");
}

std::string nameAt(std::string_view header) {
    constexpr uint64_t kNameOffset = 124, kNameLength = 256;
    if (header.size() <= kNameOffset) return "";
    const std::string_view name = header.substr(kNameOffset, kNameLength);
    return std::string(name.substr(0, name.find('\0')));
}

// Records of four numbers: u, v, 1 where valid; or x, y, z, 1 where valid.
NumberMap recordsOf(std::string_view bytes, glm::ivec2 sizePx, bool arePoints) {
    constexpr uint64_t kRecord = 4 * sizeof(float);
    NumberMap map{sizePx, arePoints ? 3 : 2, false, {}};
    map.values.reserve(bytes.size() / kRecord * static_cast<uint64_t>(map.channels));
    for (uint64_t at = 0; at < bytes.size(); at += kRecord) {
        const auto number = [&](uint64_t i) { return numberAt<float>(bytes, at + i * sizeof(float)); };
        const bool isValid = number(arePoints ? 3 : 2) > 0;
        for (uint64_t i = 0; i < static_cast<uint64_t>(map.channels); ++i)
            map.values.push_back(isValid ? number(i) : std::numeric_limits<float>::quiet_NaN());
    }
    return map;
}

ViosoWarp takeWarp(Reader& in, const FileBytes& file, const std::string& place) {
    Reader peek = in;
    const auto headerSize = numberAt<uint32_t>(peek.take(8, place), 4);
    if (headerSize < kLeastHeader || headerSize > kMostHeader)
        throw InputError(file.path, place + ".szHdr", "a header of 28 bytes to 1 MiB",
                         std::to_string(headerSize));
    const std::string_view header = in.take(headerSize, place);
    ViosoWarp warp;
    warp.place = place;
    warp.flags = numberAt<uint32_t>(header, 8);
    warp.name = nameAt(header);
    warp.blackScale = numberAt<float>(header, 96);
    warp.blackDark = numberAt<float>(header, 100);
    warp.blackBright = numberAt<float>(header, 104);
    if ((warp.flags & vioso::kEncrypted) != 0)
        throw InputError(file.path, place, "a warp that is not encrypted", "an encrypted one");
    if ((warp.flags & vioso::kZipped) != 0)
        throw InputError(file.path, place, "a warp that is not packed", "one packed by zip");
    const auto size = numberAt<uint32_t>(header, 16);
    const auto width = numberAt<int32_t>(header, 20), height = numberAt<int32_t>(header, 24);
    if (width < 1 || height < 1 || static_cast<uint64_t>(width) > kMostSide ||
        static_cast<uint64_t>(height) > kMostSide)
        throw InputError(file.path, place, "a width and height from 1 to 16384",
                         std::to_string(width) + " x " + std::to_string(height));
    warp.numbers.sizePx = {width, height};
    if (size == 0) return warp;
    const uint64_t expected = static_cast<uint64_t>(width) * static_cast<uint64_t>(height) * 16;
    if (size != expected)
        throw InputError(file.path, place + ".size", std::to_string(expected) + " bytes of records",
                         std::to_string(size));
    warp.numbers =
        recordsOf(in.take(expected, place), warp.numbers.sizePx, (warp.flags & vioso::kPoints) != 0);
    return warp;
}

float sampleAt(std::string_view row, uint64_t offset, uint64_t bytes) {
    if (bytes == 1) return static_cast<float>(static_cast<unsigned char>(row[offset])) / 255;
    if (bytes == 2) return static_cast<float>(numberAt<uint16_t>(row, offset)) / 65535;
    return numberAt<float>(row, offset);
}

// Bitmaps of 24 to 128 bits a pixel: blue, green, red and sometimes one more, in 8 or 16 bits or in floats.
// Nothing for one without pixels.
std::optional<NumberMap> takeBitmap(Reader& in, const FileBytes& file, const std::string& place) {
    constexpr uint64_t kFileHeader = 14, kInfoHeader = 40;
    Reader peek = in;
    const std::string_view header = peek.take(kFileHeader + kInfoHeader, place);
    const auto dataOffset = numberAt<uint32_t>(header, 10);
    const int64_t width = numberAt<int32_t>(header, 18), height = numberAt<int32_t>(header, 22);
    const auto bits = numberAt<uint16_t>(header, 28);
    if (dataOffset < kFileHeader + kInfoHeader || dataOffset > kMostHeader)
        throw InputError(file.path, place, "a bitmap whose pixels follow its header",
                         "pixels at byte " + std::to_string(dataOffset));
    in.take(dataOffset, place);
    if (width == 0 || height == 0) return std::nullopt;
    const int64_t rows = height < 0 ? -height : height;
    if (width < 1 || width > int64_t{kMostSide} || rows > int64_t{kMostSide})
        throw InputError(file.path, place, "a bitmap of at most 16384 pixels a side",
                         std::to_string(width) + " x " + std::to_string(height));
    if (bits != 24 && bits != 32 && bits != 48 && bits != 64 && bits != 96 && bits != 128)
        throw InputError(file.path, place, "a bitmap of 24, 32, 48, 64, 96 or 128 bits a pixel",
                         std::to_string(bits));
    if (const auto packing = numberAt<uint32_t>(header, 30); packing != 0)
        throw InputError(file.path, place, "a bitmap that is not packed",
                         "packing " + std::to_string(packing));
    const uint64_t samples = bits == 24 || bits == 48 || bits == 96 ? 3 : 4;
    const uint64_t sampleBytes = bits / 8 / samples;
    const uint64_t pitch = (static_cast<uint64_t>(width) * bits + 31) / 32 * 4;
    const std::string_view data = in.take(pitch * static_cast<uint64_t>(rows), place);
    NumberMap map{{width, rows}, 3, sampleBytes < 4, {}};
    map.values.reserve(static_cast<size_t>(3 * width * rows));
    for (int64_t y = 0; y < rows; ++y) {
        const int64_t stored = height < 0 ? y : rows - 1 - y;
        const std::string_view row = data.substr(static_cast<uint64_t>(stored) * pitch, pitch);
        for (uint64_t x = 0; x < static_cast<uint64_t>(width); ++x)
            for (const uint64_t channel : {uint64_t{2}, uint64_t{1}, uint64_t{0}})
                map.values.push_back(sampleAt(row, (x * samples + channel) * sampleBytes, sampleBytes));
    }
    return map;
}

void keepBitmap(ViosoWarp& warp, int place, std::optional<NumberMap> bitmap) {
    if (place == 0)
        warp.blend = std::move(bitmap);
    else if (place == 1)
        warp.black = std::move(bitmap);
    else
        warp.hasWhite = warp.hasWhite || bitmap.has_value();
}

}  // namespace

bool isVioso(std::string_view bytes) {
    return bytes.starts_with("vwf") && bytes.size() > 3 && bytes[3] >= '0' && bytes[3] <= '3';
}

std::vector<ViosoWarp> parseVioso(const FileBytes& file) {
    Reader in(file);
    const bool isSet = in.startsWith(kSetStart);
    uint64_t blocks = kMostBlocks;
    if (isSet) {
        const std::string_view header = in.take(kSetHeader, "the set's header");
        blocks = numberAt<uint32_t>(header, 4);
        const auto offset = numberAt<uint32_t>(header, 8);
        if (blocks > kMostBlocks)
            throw InputError(file.path, "numBlocks", "at most " + std::to_string(kMostBlocks),
                             std::to_string(blocks));
        if (offset < kSetHeader || offset > file.bytes.size())
            throw InputError(file.path, "offs", "an offset within the file", std::to_string(offset));
        in.jump(offset);
    }
    std::vector<ViosoWarp> warps;
    int bitmaps = 0;  // since the last warp
    // Without a set's header the blocks end with the file.
    for (uint64_t block = 0; block < blocks && (isSet || !in.isAtEnd()); ++block) {
        const std::string place = "block " + std::to_string(block);
        if (isWarp(in)) {
            warps.push_back(takeWarp(in, file, place));
            bitmaps = 0;
        } else if (in.startsWith("BM") && !warps.empty()) {
            keepBitmap(warps.back(), bitmaps++, takeBitmap(in, file, place));
        } else {
            throw InputError(file.path, place + " at byte " + std::to_string(in.at()),
                             "a warp, or a bitmap that follows one",
                             in.isAtEnd() ? "the end of the file" : "neither");
        }
    }
    if (warps.empty()) throw InputError(file.path, "", "a warp", "none");
    return warps;
}

}  // namespace curvewall
