#include "calibration/formats/decisions.h"

#include "calibration/formats/display_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace curvewall {
namespace {

constexpr size_t kMostWarnings = 100;

}  // namespace

Decisions::Decisions(nlohmann::json given, std::string name)
    : given_(std::move(given)), name_(std::move(name)), asked_(std::make_shared<std::set<std::string>>()) {}

const nlohmann::json* Decisions::given(const char* key) {
    asked_->insert(key);
    const auto found = given_.find(key);
    return found == given_.end() ? nullptr : &*found;
}

void Decisions::list(const char* key, const std::string& value, const std::string& evidence, bool isGiven) {
    std::erase_if(taken_, [key](const Assumption& earlier) { return earlier.key == key; });
    taken_.push_back(
        {key, validUtf8(value), isGiven ? "the wall file says so" : validUtf8(evidence), isGiven});
}

size_t Decisions::place(const char* key, const std::vector<const char*>& words, size_t guess,
                        const std::string& evidence) {
    const nlohmann::json* value = given(key);
    if (!value) {
        list(key, words[guess], evidence, false);
        return guess;
    }
    std::string expected;
    for (size_t i = 0; i < words.size(); ++i) {
        if (value->is_string() && value->get_ref<const std::string&>() == words[i]) {
            list(key, words[i], evidence, true);
            return i;
        }
        expected += (i == 0 ? "" : ", ") + std::string(words[i]);
    }
    throw FieldError(FieldError::Kind::value, name_ + "." + key, "one of " + expected, describe(*value));
}

double Decisions::number(const char* key, Range range, double guess, const std::string& evidence) {
    double number = guess;
    const bool isGiven = given(key) != nullptr;
    if (isGiven) number = *JsonFields(given_, name_).number(key, range);
    list(key, fmt::format("{}", number), evidence, isGiven);
    return number;
}

std::string Decisions::text(const char* key, const std::string& guess, const std::string& evidence) {
    std::string text = guess;
    const bool isGiven = given(key) != nullptr;
    if (isGiven) text = *JsonFields(given_, name_).text(key);
    list(key, text, evidence, isGiven);
    return text;
}

void Decisions::warn(const std::string& text) {
    std::string warning = validUtf8(text);
    if (std::ranges::find(warnings_, warning) != warnings_.end()) return;
    if (moreWarnings_ > 0) warnings_.pop_back();
    if (warnings_.size() == kMostWarnings) warning = fmt::format("and {} more", ++moreWarnings_);
    warnings_.push_back(std::move(warning));
}

void Decisions::refuseUnusedKeys() const {
    for (const auto& [key, value] : given_.items()) {
        if (asked_->contains(key)) continue;
        std::string expected;
        for (const std::string& known : *asked_) expected += (expected.empty() ? "" : ", ") + known;
        throw FieldError(FieldError::Kind::shape, name_,
                         expected.empty() ? "no key, since this file leaves nothing open"
                                          : "only what was assumed of this file: " + expected,
                         "\"" + key + "\"");
    }
}

}  // namespace curvewall
