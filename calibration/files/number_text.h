#pragma once
// Numbers in text, whatever the locale.

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace curvewall {

// Without the white space around it.
std::string_view trimmed(std::string_view text);

// The whole text as a number; a plus sign passes, which std::from_chars does not know. Of double, NaN and
// infinity are numbers too.
template <class Number>
std::optional<Number> numberFrom(std::string_view text) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

// The same without white space around it, finite.
std::optional<double> finiteNumberFrom(std::string_view text);

}  // namespace curvewall
