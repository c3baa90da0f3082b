#pragma once
// JSON files that a run leaves for the next one, so that what was cut off goes on where it was.

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace curvewall {

// Of a content key, in file names.
inline constexpr size_t kShortKey = 16;

// Nothing where there is no such file, or none that holds JSON.
std::optional<nlohmann::json> keptJson(const std::string& path);

// Nothing either where it holds something else than a Value.
template <class Value>
std::optional<Value> keptValue(const std::string& path) {
    const auto json = keptJson(path);
    if (!json) return std::nullopt;
    try {
        return json->get<Value>();
    } catch (const nlohmann::json::exception&) {
        return std::nullopt;
    }
}

// All of it or nothing: a file that is there is complete. Makes its folder. Throws std::runtime_error where
// it cannot be written.
void keepJson(const std::string& path, const nlohmann::json& json);

// JSON has no infinity and writes null for it.
inline double numberOrInfinity(const nlohmann::json& json) {
    return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

}  // namespace curvewall
