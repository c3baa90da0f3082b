#pragma once
// Strict reading of JSON that a person or a stranger wrote: no unknown key, no repeated key, no wrong type
// and no number out of range gets past this file, and each complaint names the field.

#include <nlohmann/json.hpp>

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace curvewall {

// Not JSON at all, nested too deeply, or a key given twice.
class JsonSyntaxError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

class FieldError : public std::runtime_error {
public:
    enum class Kind {
        shape,  // a key missing or unknown, or a value of the wrong type
        value,  // the right type with a value that is not possible
    };
    FieldError(Kind kindOfError, std::string fieldName, std::string whatWasExpected,
               std::string whatWasFound);

    Kind kind;
    std::string field;
    std::string expected;
    std::string found;
};

nlohmann::json parseJson(std::string_view text);

// A value as messages quote it; long strings are cut.
std::string describe(const nlohmann::json& value);

struct Range {
    double min;
    double max;
    bool aboveMin = false;  // the lower end itself is not allowed
    bool belowMax = false;  // nor is the upper end
};

// The members of one JSON object. Reading a key makes it a known one.
class JsonFields {
public:
    // `name` is how messages call the object, empty for the outermost. Throws FieldError unless it is one.
    JsonFields(const nlohmann::json& object, std::string name);

    bool has(std::string_view key) const { return object_.contains(key); }
    bool hasList(std::string_view key) const;
    void require(std::string_view key) const;

    // Nothing when the key is absent; FieldError when the value does not fit.
    std::optional<std::string> text(const char* key);
    std::optional<double> number(const char* key, Range range);
    std::optional<int64_t> wholeNumber(const char* key, int64_t min, int64_t max);
    std::optional<std::vector<double>> numbers(const char* key, size_t count, Range range);
    std::optional<std::vector<double>> numbers(const char* key, std::initializer_list<size_t> counts,
                                               Range range);
    std::optional<std::vector<int64_t>> wholeNumbers(const char* key, size_t count, int64_t min, int64_t max);
    std::vector<JsonFields> objects(const char* key);  // a list that must be there, with one entry at least
    std::optional<JsonFields> object(const char* key);
    std::optional<nlohmann::json> anyObject(const char* key);  // one whose keys are for somebody else to know
    const nlohmann::json& list(const char* key);  // of anything; must be there, with one entry at least

    // The same for a key that must be there.
    template <class Value>
    Value required(const char* key, std::optional<Value> value) const {
        require(key);
        return std::move(*value);
    }

    // To be called when every known key was read.
    void refuseUnknownKeys() const;

    std::string nameOf(std::string_view key) const;

private:
    const nlohmann::json* find(const char* key);
    const nlohmann::json* findList(const char* key, std::initializer_list<size_t> counts);

    const nlohmann::json& object_;
    std::string name_;
    std::vector<std::string_view> known_;
};

}  // namespace curvewall
