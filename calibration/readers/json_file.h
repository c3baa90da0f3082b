#pragma once
// JSON files: what is wrong with one names the file.

#include "calibration/errors.h"
#include "calibration/readers/json_fields.h"

#include <string>

namespace curvewall {

// The text of a file. Throws InputError with `expected` when there is nothing readable.
std::string readText(const std::string& path, const std::string& expected);

// read(JsonFields) makes a value of the file's outermost object. Throws InputError for what is no JSON and
// for every field that is not as expected.
template <class Read>
auto readJsonFile(const std::string& path, const std::string& expected, Read read) {
    const std::string text = readText(path, expected);
    try {
        const nlohmann::json root = parseJson(text);
        return read(JsonFields(root, ""));
    } catch (const JsonSyntaxError& error) {
        throw InputError(path, "", "JSON", error.what());
    } catch (const FieldError& error) {
        throw InputError(path, error.field, error.expected, error.found);
    }
}

}  // namespace curvewall
