#pragma once
// Strict reading of JSON objects: every field is asked for by name, its type and range are checked, and what
// was not asked for is an error. Messages name the file and the path of the field.

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace curvewall {

// Both ends are allowed unless `aboveLeast` makes the lower one exclusive.
struct Range {
    double least;
    double most;
    bool aboveLeast = false;
};

class JsonFields {
public:
    // `path` is the object's place in the file ("displays[0].projection"), empty for the root.
    // Throws InputError when `object` is not an object.
    JsonFields(std::string file, std::string path, const nlohmann::json& object);

    // Each throws InputError when the field is missing (the forms without a fallback) or not as expected.
    std::string text(std::string_view key);
    double number(std::string_view key, Range range);
    double number(std::string_view key, Range range, double fallback);
    int integer(std::string_view key, Range range);
    int integer(std::string_view key, Range range, int fallback);
    glm::dvec3 vector3(std::string_view key, Range range);
    glm::dvec3 vector3(std::string_view key, Range range, glm::dvec3 fallback);
    const nlohmann::json& array(std::string_view key,
                                size_t length);  // exactly so long; 0: at least one entry
    JsonFields object(std::string_view key);
    std::string text(std::string_view key, std::string fallback);
    JsonFields object(std::string_view key, const nlohmann::json& fallback);
    bool has(std::string_view key) const;

    // Throws InputError for the first field that nobody asked for. Call it last.
    void rejectOthers() const;

    [[noreturn]] void fail(std::string_view key, const std::string& expected, const std::string& found) const;
    std::string pathOf(std::string_view key) const;
    const std::string& file() const { return file_; }

private:
    const nlohmann::json* find(std::string_view key);
    const nlohmann::json& require(std::string_view key, const std::string& expected);
    double checkedNumber(std::string_view key, const nlohmann::json& value, Range range, bool whole) const;
    glm::dvec3 checkedVector3(std::string_view key, const nlohmann::json& value, Range range) const;

    std::string file_;
    std::string path_;
    const nlohmann::json* object_;
    std::vector<std::string> known_;
};

// Parses a whole file. Throws InputError with line and column for what is not JSON, and for repeated keys.
nlohmann::json readJsonFile(const std::string& path);

}  // namespace curvewall
