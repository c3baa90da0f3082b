#include "calibration/files/json_fields.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <utility>

namespace curvewall {
namespace {

using nlohmann::json;

constexpr int kMaxDepth = 16;
constexpr size_t kMaxQuotedCharacters = 40;

// nlohmann's messages begin with a tag in brackets that helps nobody outside the library.
std::string withoutTag(std::string_view message) {
    const size_t end = message.find("] ");
    return std::string(end == std::string_view::npos ? message : message.substr(end + 2));
}

std::string formatted(double number) {
    std::ostringstream text;
    text << number;
    return text.str();
}

// Refuses what nlohmann lets through: nesting bombs and repeated keys, of which it would keep the last. Its
// parser with a callback would do, but takes a time that grows with the square of a list's length.
class StructureCheck : public nlohmann::json_sax<json> {
public:
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_object(size_t) override {
        keysOfOpenObjects_.emplace_back();
        return open();
    }
    bool end_object() override {
        keysOfOpenObjects_.pop_back();
        --depth_;
        return true;
    }
    bool start_array(size_t) override { return open(); }
    bool end_array() override {
        --depth_;
        return true;
    }
    bool key(string_t& key) override {
        if (!keysOfOpenObjects_.back().insert(key).second)
            throw JsonSyntaxError("the key " + describe(json(key)) + " is given twice");
        return true;
    }
    bool parse_error(size_t, const std::string&, const json::exception& error) override {
        throw JsonSyntaxError(withoutTag(error.what()));
    }

private:
    bool open() {
        if (++depth_ > kMaxDepth)
            throw JsonSyntaxError("nested more than " + std::to_string(kMaxDepth) + " levels deep");
        return true;
    }

    std::vector<std::set<std::string>> keysOfOpenObjects_;
    int depth_ = 0;
};

std::string formatted(Range range) {
    const bool closed = !range.aboveMin && !range.belowMax;
    return (range.aboveMin ? " above " : " from ") + formatted(range.min) +
           (closed           ? " to "
            : range.belowMax ? ", below "
                             : ", at most ") +
           formatted(range.max);
}

double checkedNumber(const json& value, const std::string& field, Range range) {
    if (!value.is_number()) throw FieldError(FieldError::Kind::shape, field, "a number", describe(value));
    const double number = value.get<double>();
    if (!(number >= range.min && number <= range.max) || (range.aboveMin && number == range.min) ||
        (range.belowMax && number == range.max))
        throw FieldError(FieldError::Kind::value, field, "a number" + formatted(range), describe(value));
    return number;
}

int64_t checkedWholeNumber(const json& value, const std::string& field, int64_t min, int64_t max) {
    // Through double, so that 16.0 is 16 and no integer type overflows before the range is known to hold.
    if (!value.is_number() || value.get<double>() != std::floor(value.get<double>()))
        throw FieldError(FieldError::Kind::shape, field, "a whole number", describe(value));
    if (const double number = value.get<double>();
        number < static_cast<double>(min) || number > static_cast<double>(max))
        throw FieldError(FieldError::Kind::value, field,
                         "a whole number from " + std::to_string(min) + " to " + std::to_string(max),
                         describe(value));
    return value.get<int64_t>();
}

// "0, 4 or 5"
std::string listed(std::initializer_list<size_t> counts) {
    std::string text;
    for (const size_t& count : counts) {
        if (&count != counts.begin()) text += &count + 1 == counts.end() ? " or " : ", ";
        text += std::to_string(count);
    }
    return text;
}

std::string placeOf(const std::string& list, size_t index) {
    return list + "[" + std::to_string(index) + "]";
}

}  // namespace

FieldError::FieldError(Kind kindOfError, std::string fieldName, std::string whatWasExpected,
                       std::string whatWasFound)
    : std::runtime_error((fieldName.empty() ? "" : fieldName + ": ") + "expected " + whatWasExpected +
                         ", found " + whatWasFound),
      kind(kindOfError),
      field(std::move(fieldName)),
      expected(std::move(whatWasExpected)),
      found(std::move(whatWasFound)) {}

json parseJson(std::string_view text) {
    // nlohmann takes a zero byte for the end and would not look at what follows.
    if (text.find('\0') != std::string_view::npos) throw JsonSyntaxError("there is a zero byte in it");
    StructureCheck check;
    json::sax_parse(text, &check);
    try {
        return json::parse(text);
    } catch (const json::exception& error) {
        throw JsonSyntaxError(withoutTag(error.what()));
    }
}

std::string describe(const json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return "a list";
    // The ASCII form cannot be cut in the middle of a character.
    std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
    if (text.size() <= kMaxQuotedCharacters) return text;
    text.resize(kMaxQuotedCharacters);
    return text + (value.is_string() ? "...\"" : "...");
}

JsonFields::JsonFields(const json& object, std::string name) : object_(object), name_(std::move(name)) {
    if (!object.is_object()) throw FieldError(FieldError::Kind::shape, name_, "an object", describe(object));
}

void JsonFields::require(std::string_view key) const {
    if (!has(key)) throw FieldError(FieldError::Kind::shape, nameOf(key), "a value", "nothing");
}

bool JsonFields::hasList(std::string_view key) const {
    const auto found = object_.find(key);
    return found != object_.end() && found->is_array();
}

std::optional<std::string> JsonFields::text(const char* key) {
    const json* value = find(key);
    if (!value) return std::nullopt;
    if (!value->is_string())
        throw FieldError(FieldError::Kind::shape, nameOf(key), "a string", describe(*value));
    return value->get<std::string>();
}

std::optional<double> JsonFields::number(const char* key, Range range) {
    const json* value = find(key);
    if (!value) return std::nullopt;
    return checkedNumber(*value, nameOf(key), range);
}

std::optional<int64_t> JsonFields::wholeNumber(const char* key, int64_t min, int64_t max) {
    const json* value = find(key);
    if (!value) return std::nullopt;
    return checkedWholeNumber(*value, nameOf(key), min, max);
}

std::optional<std::vector<double>> JsonFields::numbers(const char* key, size_t count, Range range) {
    return numbers(key, std::initializer_list<size_t>{count}, range);
}

std::optional<std::vector<double>> JsonFields::numbers(const char* key, std::initializer_list<size_t> counts,
                                                       Range range) {
    const json* list = findList(key, counts);
    if (!list) return std::nullopt;
    std::vector<double> numbers;
    for (const json& value : *list)
        numbers.push_back(checkedNumber(value, placeOf(nameOf(key), numbers.size()), range));
    return numbers;
}

std::optional<std::vector<int64_t>> JsonFields::wholeNumbers(const char* key, size_t count, int64_t min,
                                                             int64_t max) {
    const json* list = findList(key, {count});
    if (!list) return std::nullopt;
    std::vector<int64_t> numbers;
    for (const json& value : *list)
        numbers.push_back(checkedWholeNumber(value, placeOf(nameOf(key), numbers.size()), min, max));
    return numbers;
}

std::vector<JsonFields> JsonFields::objects(const char* key) {
    std::vector<JsonFields> objects;
    for (const json& value : list(key)) objects.emplace_back(value, placeOf(nameOf(key), objects.size()));
    return objects;
}

const json& JsonFields::list(const char* key) {
    const json* list = find(key);
    if (!list || !list->is_array() || list->empty())
        throw FieldError(FieldError::Kind::shape, nameOf(key), "a list with one entry at least",
                         !list              ? "nothing"
                         : list->is_array() ? "none"
                                            : describe(*list));
    return *list;
}

std::optional<JsonFields> JsonFields::object(const char* key) {
    const json* value = find(key);
    if (!value) return std::nullopt;
    return JsonFields(*value, nameOf(key));
}

std::optional<json> JsonFields::anyObject(const char* key) {
    const json* value = find(key);
    if (!value) return std::nullopt;
    if (!value->is_object())
        throw FieldError(FieldError::Kind::shape, nameOf(key), "an object", describe(*value));
    return *value;
}

void JsonFields::refuseUnknownKeys() const {
    for (const auto& [key, value] : object_.items()) {
        if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
        std::string expected = "only the keys ";
        for (size_t i = 0; i < known_.size(); ++i) {
            if (i > 0) expected += ", ";
            expected += known_[i];
        }
        throw FieldError(FieldError::Kind::shape, name_, expected, "the key " + describe(key));
    }
}

std::string JsonFields::nameOf(std::string_view key) const {
    return name_.empty() ? std::string(key) : name_ + "." + std::string(key);
}

const json* JsonFields::find(const char* key) {
    known_.emplace_back(key);
    const auto found = object_.find(key);
    return found == object_.end() ? nullptr : &*found;
}

const json* JsonFields::findList(const char* key, std::initializer_list<size_t> counts) {
    const json* value = find(key);
    if (!value) return nullptr;
    if (!value->is_array() || std::ranges::find(counts, value->size()) == counts.end())
        throw FieldError(FieldError::Kind::shape, nameOf(key), "a list of " + listed(counts) + " numbers",
                         value->is_array() ? "a list of " + std::to_string(value->size()) : describe(*value));
    return value;
}

}  // namespace curvewall
