#include "calibration/files/pfm_file.h"

#include "calibration/errors.h"

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <istream>
#include <span>
#include <streambuf>

namespace curvewall {
namespace {

constexpr size_t kMaxToken = 32;

bool isSpace(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

// Reads bytes where they are.
class BytesBuffer : public std::streambuf {
public:
    explicit BytesBuffer(std::string_view bytes) {
        char* begin = const_cast<char*>(bytes.data());  // only ever read
        setg(begin, begin, begin + bytes.size());
    }
};

// A file and how much of it is left.
struct Input {
    std::istream& in;
    uint64_t bytesLeft;
    const std::string& path;

    bool get(char& c) {
        if (!in.get(c)) return false;
        --bytesLeft;
        return true;
    }
    InputError error(const std::string& expected, const std::string& found) const {
        return {path, "", expected, found};
    }
};

// The next word of the header and the one white space character behind it.
std::string nextWord(Input& input) {
    std::string word;
    char c = 0;
    while (input.get(c) && isSpace(c)) {
    }
    while (input.in && !isSpace(c) && word.size() < kMaxToken) {
        word += c;
        input.get(c);
    }
    return input.in ? word : "";
}

template <class Number>
Number parsed(const std::string& word) {
    Number number{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc() && end == word.data() + word.size() ? number : Number{};
}

float swapped(float value) { return std::bit_cast<float>(__builtin_bswap32(std::bit_cast<uint32_t>(value))); }

// The share of numbers that a map could hold, of those that are numbers. Read in the wrong byte order five
// in six of them are tiny or huge.
double plausibleShare(std::span<const float> values, bool swap) {
    constexpr size_t kMostLooked = 65536;
    constexpr float kLeast = 1e-6f, kMost = 1e6f;
    const size_t step = values.size() / kMostLooked + 1;
    size_t numbers = 0, plausible = 0;
    for (size_t i = 0; i < values.size(); i += step) {
        const float value = swap ? swapped(values[i]) : values[i];
        if (std::isnan(value)) continue;
        ++numbers;
        const float size = std::abs(value);
        plausible += size == 0 || (size >= kLeast && size <= kMost);
    }
    return numbers > 0 ? static_cast<double>(plausible) / static_cast<double>(numbers) : 1;
}

void requireByteOrder(const Input& input, const NumberMap& map, const std::string& scale) {
    constexpr double kFew = 0.5, kNearlyAll = 0.9;
    if (plausibleShare(map.values, false) >= kFew || plausibleShare(map.values, true) < kNearlyAll) return;
    throw input.error("numbers in the byte order that the scale " + scale + " stands for",
                      "numbers that make sense only in the other one");
}

NumberMap readFrom(Input input, const AllowSize& allow = {}) {
    NumberMap map;
    map.channels = nextWord(input) == "PF" ? 3 : 1;
    const std::string width = nextWord(input), height = nextWord(input), scale = nextWord(input);
    map.sizePx = {parsed<int>(width), parsed<int>(height)};
    if (map.sizePx.x < 1 || map.sizePx.y < 1)
        throw input.error("a PFM header with width and height", "\"" + width + " " + height + "\"");
    if (int64_t{map.sizePx.x} * map.sizePx.y > kMaxMapTexels)
        throw input.error("at most " + std::to_string(kMaxMapTexels) + " pixels", width + " x " + height);
    const auto order = parsed<double>(scale);
    if (!(std::isfinite(order) && order != 0))
        throw input.error("a PFM header with a scale other than 0", "\"" + scale + "\"");

    const size_t rowValues = static_cast<size_t>(map.sizePx.x) * static_cast<size_t>(map.channels);
    const uint64_t expected = rowValues * sizeof(float) * static_cast<uint64_t>(map.sizePx.y);
    if (input.bytesLeft != expected)
        throw input.error(std::to_string(expected) + " bytes of numbers after the PFM header",
                          std::to_string(input.bytesLeft));
    map.scale = std::abs(order);
    if (allow) allow(map.sizePx);
    map.values.resize(rowValues * static_cast<size_t>(map.sizePx.y));
    for (auto row = static_cast<size_t>(map.sizePx.y); row-- > 0;)
        if (!input.in.read(reinterpret_cast<char*>(&map.values[row * rowValues]),
                           static_cast<std::streamsize>(rowValues * sizeof(float))))
            throw input.error("readable numbers", "an error");
    if ((order > 0) != (std::endian::native == std::endian::big))
        std::ranges::transform(map.values, map.values.begin(), swapped);
    requireByteOrder(input, map, scale);
    return map;
}

}  // namespace

bool isPfm(std::string_view bytes) {
    return bytes.size() > 2 && bytes[0] == 'P' && (bytes[1] == 'F' || bytes[1] == 'f') && isSpace(bytes[2]);
}

NumberMap parsePfm(const FileBytes& file, const AllowSize& allow) {
    BytesBuffer buffer(file.bytes);
    std::istream in(&buffer);
    return readFrom({in, file.bytes.size(), file.path}, allow);
}

bool isPfmFile(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    char start[3]{};
    return in.read(start, sizeof start) && isPfm({start, sizeof start});
}

NumberMap readPfm(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::error_code error;
    const uint64_t size = std::filesystem::file_size(path, error);
    return readFrom({in, error ? 0 : size, path});
}

}  // namespace curvewall
