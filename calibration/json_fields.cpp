#include "calibration/json_fields.h"

#include "calibration/errors.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

namespace curvewall {
namespace {

using nlohmann::json;

std::string shown(const json& value) {
    std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
    if (text.size() > 60) text = text.substr(0, 57) + "...";
    return text;
}

std::string shown(double value) {
    std::ostringstream out;
    out << value;
    return out.str();
}

std::string shown(Range range) {
    if (std::isinf(range.most) && std::isinf(range.least)) return "";
    if (std::isinf(range.most)) return (range.aboveLeast ? " above " : " of at least ") + shown(range.least);
    return (range.aboveLeast ? " above " : " from ") + shown(range.least) +
           (range.aboveLeast ? " and at most " : " to ") + shown(range.most);
}

}  // namespace

JsonFields::JsonFields(std::string file, std::string path, const json& object)
    : file_(std::move(file)), path_(std::move(path)), object_(&object) {
    if (!object.is_object()) throw InputError(file_, path_, "an object", shown(object));
}

std::string JsonFields::pathOf(std::string_view key) const {
    return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

void JsonFields::fail(std::string_view key, const std::string& expected, const std::string& found) const {
    throw InputError(file_, pathOf(key), expected, found);
}

bool JsonFields::has(std::string_view key) const { return object_->contains(key); }

const json* JsonFields::find(std::string_view key) {
    known_.emplace_back(key);
    const auto field = object_->find(key);
    return field == object_->end() ? nullptr : &*field;
}

const json& JsonFields::require(std::string_view key, const std::string& expected) {
    const json* value = find(key);
    if (!value) fail(key, expected, "nothing");
    return *value;
}

std::string JsonFields::text(std::string_view key) {
    const json& value = require(key, "a text");
    if (!value.is_string() || value.get_ref<const std::string&>().empty()) fail(key, "a text", shown(value));
    return value.get<std::string>();
}

std::string JsonFields::text(std::string_view key, std::string fallback) {
    return has(key) ? text(key) : (known_.emplace_back(key), std::move(fallback));
}

double JsonFields::checkedNumber(std::string_view key, const json& value, Range range, bool whole) const {
    const std::string expected = (whole ? "a whole number" : "a number") + shown(range);
    if (!value.is_number()) fail(key, expected, shown(value));
    const double number = value.get<double>();
    const bool inRange =
        (range.aboveLeast ? number > range.least : number >= range.least) && number <= range.most;
    if (!std::isfinite(number) || !inRange || (whole && number != std::floor(number)))
        fail(key, expected, shown(value));
    return number;
}

double JsonFields::number(std::string_view key, Range range) {
    return checkedNumber(key, require(key, "a number" + shown(range)), range, false);
}

double JsonFields::number(std::string_view key, Range range, double fallback) {
    const json* value = find(key);
    return value ? checkedNumber(key, *value, range, false) : fallback;
}

int JsonFields::integer(std::string_view key, Range range) {
    return static_cast<int>(checkedNumber(key, require(key, "a whole number" + shown(range)), range, true));
}

int JsonFields::integer(std::string_view key, Range range, int fallback) {
    const json* value = find(key);
    return value ? static_cast<int>(checkedNumber(key, *value, range, true)) : fallback;
}

glm::dvec3 JsonFields::checkedVector3(std::string_view key, const json& value, Range range) const {
    if (!value.is_array() || value.size() != 3) fail(key, "three numbers [x, y, z]", shown(value));
    glm::dvec3 vector;
    for (int i = 0; i < 3; ++i)
        vector[i] = checkedNumber(std::string(key) + "[" + std::to_string(i) + "]",
                                  value[static_cast<size_t>(i)], range, false);
    return vector;
}

glm::dvec3 JsonFields::vector3(std::string_view key, Range range) {
    return checkedVector3(key, require(key, "three numbers [x, y, z]"), range);
}

glm::dvec3 JsonFields::vector3(std::string_view key, Range range, glm::dvec3 fallback) {
    const json* value = find(key);
    return value ? checkedVector3(key, *value, range) : fallback;
}

const json& JsonFields::array(std::string_view key, size_t length) {
    const std::string expected =
        length == 0 ? "a list with at least one entry" : "a list of " + std::to_string(length) + " entries";
    const json& value = require(key, expected);
    if (!value.is_array() || (length == 0 ? value.empty() : value.size() != length))
        fail(key, expected, shown(value));
    return value;
}

JsonFields JsonFields::object(std::string_view key) {
    return {file_, pathOf(key), require(key, "an object")};
}

JsonFields JsonFields::object(std::string_view key, const json& fallback) {
    const json* value = find(key);
    return {file_, pathOf(key), value ? *value : fallback};
}

void JsonFields::rejectOthers() const {
    for (const auto& [key, value] : object_->items()) {
        if (std::ranges::find(known_, key) != known_.end()) continue;
        std::string names;
        for (const std::string& name : known_) names += (names.empty() ? "" : ", ") + name;
        fail(key, "one of the keys " + names, "an unknown key");
    }
}

json readJsonFile(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::stringstream bytes;
    // The buffer of a directory opens but does not read.
    if (!in || !(bytes << in.rdbuf())) throw InputError(path, "", "a readable JSON file", "none that opens");

    std::vector<std::set<std::string>> keysOfOpenObjects;
    std::string repeated;
    const auto noticeRepeatedKeys = [&](int, json::parse_event_t event, json& parsed) {
        if (event == json::parse_event_t::object_start) keysOfOpenObjects.emplace_back();
        if (event == json::parse_event_t::object_end) keysOfOpenObjects.pop_back();
        if (event == json::parse_event_t::key &&
            !keysOfOpenObjects.back().insert(parsed.get<std::string>()).second)
            repeated = parsed.get<std::string>();
        return true;
    };
    try {
        json value = json::parse(bytes.str(), noticeRepeatedKeys);
        if (!repeated.empty()) throw InputError(path, repeated, "each key once", "it twice in one object");
        return value;
    } catch (const json::parse_error& error) {
        throw InputError(path, "", "JSON", error.what());
    }
}

}  // namespace curvewall
