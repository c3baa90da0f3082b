#pragma once
// JSON files: what is wrong with one names the file.

#include "calibration/errors.h"
#include "calibration/files/file_bytes.h"
#include "calibration/files/json_fields.h"

#include <string>

namespace curvewall {

// read(JsonFields) makes a value of the file's outermost object. Throws InputError for what is no JSON and
// for every field that is not as expected.
template <class Read>
auto readJson(const FileBytes& file, Read read) {
    try {
        const nlohmann::json root = parseJson(file.bytes);
        return read(JsonFields(root, ""));
    } catch (const JsonSyntaxError& error) {
        throw InputError(file.path, "", "JSON", error.what());
    } catch (const FieldError& error) {
        throw InputError(file.path, error.field, error.expected, error.found);
    }
}

template <class Read>
auto readJsonFile(const std::string& path, const std::string& expected, Read read) {
    return readJson(readFile(path, expected), read);
}

}  // namespace curvewall
