#include "report/code_spans.h"

namespace curvewall {

std::vector<TextSpan> codeSpans(std::string_view text) {
    std::vector<TextSpan> spans;
    const auto add = [&](std::string_view part, bool isCode) {
        if (!part.empty()) spans.push_back({part, isCode});
    };
    for (;;) {
        const size_t open = text.find('`');
        const size_t close = open == std::string_view::npos ? open : text.find('`', open + 1);
        if (close == std::string_view::npos) break;
        add(text.substr(0, open), false);
        add(text.substr(open + 1, close - open - 1), true);
        text.remove_prefix(close + 1);
    }
    add(text, false);
    return spans;
}

}  // namespace curvewall
