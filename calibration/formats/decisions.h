#pragma once
// How a reader decides what its file does not say, so that every such decision is known to the user and can
// be overruled by him: the only way from a guess to the value that is used leads through here.

#include "calibration/assumptions.h"
#include "calibration/files/json_fields.h"

#include <nlohmann/json.hpp>

#include <initializer_list>
#include <memory>
#include <set>
#include <string>
#include <type_traits>
#include <vector>

namespace curvewall {

template <class Value>
struct Option {
    const char* word;
    Value value;
};

// A copy goes on with what was decided so far, for one of several displays of a file. All copies know
// together which keys were asked for.
class Decisions {
public:
    // `given` is the wall file's "assume", an object of words and numbers, and `name` what messages call it.
    explicit Decisions(nlohmann::json given = nlohmann::json::object(), std::string name = "assume");

    // What the wall file gives for `key`, or else `guess`, for which `evidence` speaks. Throws FieldError
    // where the wall file gives none of the options. Of two decisions of one key the later one is listed.
    template <class Value>
    Value choose(const char* key, std::initializer_list<Option<std::type_identity_t<Value>>> options,
                 Value guess, const std::string& evidence);

    // The same for a number. Throws FieldError out of the range.
    double number(const char* key, Range range, double guess, const std::string& evidence);

    // The same for a name, of a file for example.
    std::string text(const char* key, const std::string& guess, const std::string& evidence);

    // What contradicts itself, and where: "buffer[0].region[2]: ...". Of more than a hundred warnings the
    // last one says how many there are besides.
    void warn(const std::string& text);

    const std::vector<Assumption>& taken() const { return taken_; }
    const std::vector<std::string>& warnings() const { return warnings_; }

    // To be called after reading. Throws FieldError for a given key that nothing was asked about, with those
    // that were.
    void refuseUnusedKeys() const;

private:
    const nlohmann::json* given(const char* key);
    size_t place(const char* key, const std::vector<const char*>& words, size_t guess,
                 const std::string& evidence);
    void list(const char* key, const std::string& value, const std::string& evidence, bool isGiven);

    nlohmann::json given_;
    std::string name_;
    std::shared_ptr<std::set<std::string>> asked_;
    std::vector<Assumption> taken_;
    std::vector<std::string> warnings_;
    size_t moreWarnings_ = 0;
};

template <class Value>
Value Decisions::choose(const char* key, std::initializer_list<Option<std::type_identity_t<Value>>> options,
                        Value guess, const std::string& evidence) {
    std::vector<const char*> words;
    size_t guessed = 0;
    for (const auto& option : options) {
        if (option.value == guess) guessed = words.size();
        words.push_back(option.word);
    }
    return (options.begin() + place(key, words, guessed, evidence))->value;
}

}  // namespace curvewall
