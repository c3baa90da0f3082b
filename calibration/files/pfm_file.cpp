#include "calibration/files/pfm_file.h"

#include "calibration/errors.h"

#include <bit>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>

namespace curvewall {
namespace {

constexpr size_t kMaxToken = 32;

bool isSpace(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

// The next word of the header and the one white space character behind it.
std::string nextWord(std::istream& in) {
    std::string word;
    char c = 0;
    while (in.get(c) && isSpace(c)) {
    }
    while (in && !isSpace(c) && word.size() < kMaxToken) {
        word += c;
        in.get(c);
    }
    return in ? word : "";
}

template <class Number>
Number parsed(const std::string& word) {
    Number number{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc() && end == word.data() + word.size() ? number : Number{};
}

void swapBytes(std::span<float> values) {
    for (float& value : values)
        value = std::bit_cast<float>(__builtin_bswap32(std::bit_cast<uint32_t>(value)));
}

}  // namespace

bool isPfm(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    char start[3]{};
    return in.read(start, sizeof start) && start[0] == 'P' && (start[1] == 'F' || start[1] == 'f') &&
           isSpace(start[2]);
}

NumberMap readPfm(const std::string& path) {
    const auto fail = [&path](const std::string& expected, const std::string& found) {
        return InputError(path, "", expected, found);
    };
    std::ifstream in(path, std::ios::binary);
    NumberMap map;
    map.channels = nextWord(in) == "PF" ? 3 : 1;
    const std::string width = nextWord(in), height = nextWord(in), scale = nextWord(in);
    map.sizePx = {parsed<int>(width), parsed<int>(height)};
    if (map.sizePx.x < 1 || map.sizePx.y < 1)
        throw fail("a PFM header with width and height", "\"" + width + " " + height + "\"");
    if (int64_t{map.sizePx.x} * map.sizePx.y > kMaxMapTexels)
        throw fail("at most " + std::to_string(kMaxMapTexels) + " pixels", width + " x " + height);
    const auto order = parsed<double>(scale);
    if (!(std::isfinite(order) && order != 0))
        throw fail("a PFM header with a scale other than 0", "\"" + scale + "\"");

    const size_t rowValues = static_cast<size_t>(map.sizePx.x) * static_cast<size_t>(map.channels);
    const uint64_t expected = rowValues * sizeof(float) * static_cast<uint64_t>(map.sizePx.y);
    std::error_code error;
    const uint64_t found = std::filesystem::file_size(path, error) - static_cast<uint64_t>(in.tellg());
    if (error || found != expected)
        throw fail(std::to_string(expected) + " bytes of numbers after the PFM header",
                   std::to_string(error ? 0 : found));

    map.values.resize(rowValues * static_cast<size_t>(map.sizePx.y));
    for (auto row = static_cast<size_t>(map.sizePx.y); row-- > 0;)
        if (!in.read(reinterpret_cast<char*>(&map.values[row * rowValues]),
                     static_cast<std::streamsize>(rowValues * sizeof(float))))
            throw fail("readable numbers", "an error");
    if ((order > 0) != (std::endian::native == std::endian::big)) swapBytes(map.values);
    return map;
}

}  // namespace curvewall
