#include "calibration/files/number_text.h"

#include <cmath>

namespace curvewall {

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\n\r\f\v";
    const size_t first = text.find_first_not_of(kBlanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::optional<double> finiteNumberFrom(std::string_view text) {
    const auto number = numberFrom<double>(trimmed(text));
    return number && std::isfinite(*number) ? number : std::nullopt;
}

}  // namespace curvewall
