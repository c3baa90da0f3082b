#pragma once
// The markup of a document's texts: `code`.

#include <string_view>
#include <vector>

namespace curvewall {

struct TextSpan {
    std::string_view text;  // lives as long as the text that it is of
    bool isCode = false;

    bool operator==(const TextSpan&) const = default;
};

// None is empty. A backtick without a second one stands for itself.
std::vector<TextSpan> codeSpans(std::string_view text);

}  // namespace curvewall
