#include "calibration/files/yaml_values.h"

#include "calibration/errors.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <sstream>
#include <stdexcept>

namespace curvewall {
namespace {

// A calibration with the corners of a hundred checkerboards has one or two.
constexpr size_t kMostBytes = size_t{8} << 20;
constexpr size_t kMostNames = 2;

class UnusableYaml : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

// Events instead of nodes: nodes take hundreds of bytes for two of the file, and aliases let them form rings.
class FlatValues : public YAML::EventHandler {
public:
    explicit FlatValues(YamlValues& values) : values_(values) {}

    void OnDocumentStart(const YAML::Mark&) override {}
    void OnDocumentEnd() override {}
    void OnNull(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override { addScalar(""); }
    void OnAlias(const YAML::Mark& /*mark*/, YAML::anchor_t /*anchor*/) override {
        throw UnusableYaml("an alias");
    }
    void OnScalar(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                  const std::string& value) override {
        addScalar(value);
    }
    void OnSequenceStart(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                         YAML::EmitterStyle::value /*style*/) override {
        enter(Inside::list);
    }
    void OnSequenceEnd() override { leave(); }
    void OnMapStart(const YAML::Mark& /*mark*/, const std::string& /*tag*/, YAML::anchor_t /*anchor*/,
                    YAML::EmitterStyle::value /*style*/) override {
        enter(Inside::mapBeforeName);
    }
    void OnMapEnd() override { leave(); }

private:
    enum class Inside { list, mapBeforeName, mapBeforeValue };

    void addScalar(const std::string& text) {
        if (inside_.empty()) throw UnusableYaml("a single value");
        if (inside_.back() == Inside::mapBeforeName) {
            names_.push_back(text);
            inside_.back() = Inside::mapBeforeValue;
            return;
        }
        if (names_.size() <= kMostNames && !names_.empty()) valuesHere().push_back(text);
        endValue();
    }

    void enter(Inside what) {
        if (inside_.empty() ? what == Inside::list : inside_.back() == Inside::mapBeforeName)
            throw UnusableYaml(inside_.empty() ? "a list" : "a name that is no text");
        inside_.push_back(what);
        // An empty list is a value too.
        if (what == Inside::list && names_.size() <= kMostNames) valuesHere();
    }

    void leave() {
        inside_.pop_back();
        if (!inside_.empty()) endValue();
    }

    void endValue() {
        if (inside_.back() != Inside::mapBeforeValue) return;
        names_.pop_back();
        inside_.back() = Inside::mapBeforeName;
    }

    std::vector<std::string>& valuesHere() {
        return values_[names_.size() == 1 ? names_[0] : names_[0] + "." + names_[1]];
    }

    YamlValues& values_;
    std::vector<Inside> inside_;
    std::vector<std::string> names_;
};

// OpenCV begins its files with "%YAML:1.0", which is no directive of YAML, and older versions go on without
// the line "---" that has to follow one.
std::string withoutDirective(const std::string& bytes) {
    return bytes.starts_with("%YAML") ? bytes.substr(std::min(bytes.find('\n'), bytes.size())) : bytes;
}

}  // namespace

YamlValues readYamlValues(const FileBytes& file) {
    const std::string expected = "a map of names in YAML";
    if (file.bytes.size() > kMostBytes)
        throw InputError(file.path, "", expected + " of at most " + std::to_string(kMostBytes) + " bytes",
                         std::to_string(file.bytes.size()) + " bytes");
    YamlValues values;
    FlatValues handler(values);
    std::istringstream in(withoutDirective(file.bytes));
    try {
        if (!YAML::Parser(in).HandleNextDocument(handler)) throw UnusableYaml("an empty file");
    } catch (const YAML::Exception& error) {
        throw InputError(file.path, "", expected, error.what());
    } catch (const UnusableYaml& error) {
        throw InputError(file.path, "", expected, error.what());
    }
    return values;
}

}  // namespace curvewall
