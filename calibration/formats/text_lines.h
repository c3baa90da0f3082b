#pragma once
// Calibrations in plain text, a line at a time. Numbers are read alike in every locale.

#include "calibration/files/file_bytes.h"
#include "calibration/files/number_text.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace curvewall {

struct TextLine {
    size_t number = 0;  // from 1
    std::string_view text;

    std::string name() const { return "line " + std::to_string(number); }
};

class TextLines {
public:
    explicit TextLines(const FileBytes& file);  // which has to outlive the lines

    // The next line that is not blank, without the blanks at its ends.
    std::optional<TextLine> next();

private:
    std::string_view rest_;
    size_t number_ = 0;
};

std::vector<std::string_view> wordsOf(std::string_view text);
std::vector<std::string_view> fieldsOf(std::string_view text, char separator);  // without blanks around them

// Nothing unless all of the text is one number. It may be infinite or none ("nan").
std::optional<double> numberOf(std::string_view text);
std::optional<int64_t> wholeNumberOf(std::string_view text);

// Nothing unless there are `count` numbers and nothing else.
std::optional<std::vector<double>> numbersOf(const std::vector<std::string_view>& texts, size_t count);

// Text of a stranger as messages quote it: cut, and only printable ASCII.
std::string quotedText(std::string_view text);

[[noreturn]] void refuseLine(const FileBytes& file, const TextLine& line, const std::string& expected);

}  // namespace curvewall
