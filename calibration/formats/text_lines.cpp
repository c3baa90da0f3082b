#include "calibration/formats/text_lines.h"

#include "calibration/errors.h"

#include <algorithm>

namespace curvewall {
namespace {

constexpr std::string_view kBlanks = " \t\r\f\v";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

}  // namespace

TextLines::TextLines(const FileBytes& file) : rest_(file.bytes) {
    if (rest_.starts_with(kByteOrderMark)) rest_.remove_prefix(kByteOrderMark.size());
}

std::optional<TextLine> TextLines::next() {
    while (!rest_.empty()) {
        const size_t end = std::min(rest_.find('\n'), rest_.size());
        const std::string_view text = trimmed(rest_.substr(0, end));
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        ++number_;
        if (!text.empty()) return TextLine{number_, text};
    }
    return std::nullopt;
}

std::vector<std::string_view> wordsOf(std::string_view text) {
    std::vector<std::string_view> words;
    for (;;) {
        const size_t first = text.find_first_not_of(kBlanks);
        if (first == std::string_view::npos) return words;
        text.remove_prefix(first);
        const size_t end = std::min(text.find_first_of(kBlanks), text.size());
        words.push_back(text.substr(0, end));
        text.remove_prefix(end);
    }
}

std::vector<std::string_view> fieldsOf(std::string_view text, char separator) {
    std::vector<std::string_view> fields;
    for (;;) {
        const size_t end = text.find(separator);
        fields.push_back(trimmed(text.substr(0, end)));
        if (end == std::string_view::npos) return fields;
        text.remove_prefix(end + 1);
    }
}

std::optional<double> numberOf(std::string_view text) { return numberFrom<double>(text); }

std::optional<int64_t> wholeNumberOf(std::string_view text) { return numberFrom<int64_t>(text); }

std::optional<std::vector<double>> numbersOf(const std::vector<std::string_view>& texts, size_t count) {
    if (texts.size() != count) return std::nullopt;
    std::vector<double> numbers;
    for (const std::string_view text : texts) {
        const auto number = numberOf(text);
        if (!number) return std::nullopt;
        numbers.push_back(*number);
    }
    return numbers;
}

std::string quotedText(std::string_view text) {
    constexpr size_t kMost = 60;
    std::string shown(text.substr(0, kMost));
    std::ranges::replace_if(
        shown, [](char c) { return c < ' ' || c > '~'; }, '?');
    return "\"" + shown + (text.size() > kMost ? "...\"" : "\"");
}

void refuseLine(const FileBytes& file, const TextLine& line, const std::string& expected) {
    throw InputError(file.path, line.name(), expected, quotedText(line.text));
}

}  // namespace curvewall
