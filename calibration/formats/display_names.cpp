#include "calibration/formats/display_names.h"

#include <cstddef>
#include <cstdint>

namespace curvewall {
namespace {

uint8_t byteAt(std::string_view text, size_t index) {
    return index < text.size() ? static_cast<uint8_t>(text[index]) : uint8_t{0};
}

bool isWithin(uint8_t byte, int low, int high) { return byte >= low && byte <= high; }

// Bytes of the character that the text begins with, 0 where it is none: table 3-7 of the Unicode standard,
// without the overlong forms and surrogates that JSON refuses too.
size_t characterBytes(std::string_view text) {
    const uint8_t first = byteAt(text, 0), second = byteAt(text, 1);
    const auto isTail = [text](size_t index) { return isWithin(byteAt(text, index), 0x80, 0xBF); };
    if (first < 0x80) return 1;
    if (isWithin(first, 0xC2, 0xDF)) return isTail(1) ? 2 : 0;
    if (isWithin(first, 0xE0, 0xEF)) {
        const bool isSecond = isWithin(second, first == 0xE0 ? 0xA0 : 0x80, first == 0xED ? 0x9F : 0xBF);
        return isSecond && isTail(2) ? 3 : 0;
    }
    if (isWithin(first, 0xF0, 0xF4)) {
        const bool isSecond = isWithin(second, first == 0xF0 ? 0x90 : 0x80, first == 0xF4 ? 0x8F : 0xBF);
        return isSecond && isTail(2) && isTail(3) ? 4 : 0;
    }
    return 0;
}

// A valid character; those above 0x7F have a second byte.
bool isControl(std::string_view character) {
    const uint8_t first = byteAt(character, 0);
    return first < 0x20 || first == 0x7F || (first == 0xC2 && byteAt(character, 1) < 0xA0);
}

}  // namespace

std::string validUtf8(std::string_view text) {
    std::string valid;
    while (!text.empty()) {
        const size_t bytes = characterBytes(text);
        if (bytes > 0) {
            valid += text.substr(0, bytes);
        } else {
            const uint8_t latin1 = byteAt(text, 0);
            valid += static_cast<char>(0xC0 | latin1 >> 6);
            valid += static_cast<char>(0x80 | (latin1 & 0x3F));
        }
        text.remove_prefix(bytes > 0 ? bytes : 1);
    }
    return valid;
}

std::string safeDisplayName(const std::string& name) {
    const std::string valid = validUtf8(name);
    std::string safe;
    for (std::string_view rest = valid; !rest.empty();) {
        const std::string_view character = rest.substr(0, characterBytes(rest));
        const bool isPart = character != "/" && character != "\\" && !isControl(character);
        safe += isPart ? character : "_";
        rest.remove_prefix(character.size());
    }
    return safe.empty() ? "display" : safe;
}

std::string uniqueName(const std::string& name, std::set<std::string>& taken) {
    std::string unique = name;
    for (int i = 2; !taken.insert(unique).second; ++i) unique = name + "-" + std::to_string(i);
    return unique;
}

}  // namespace curvewall
