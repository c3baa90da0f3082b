#pragma once
// What goes wrong outside the program's control, told so that a person can repair it.

#include <stdexcept>
#include <string>

namespace curvewall {

// A file that cannot be used. The message reads "FILE: FIELD: expected WHAT, found WHAT".
// `field` may be empty when the file as a whole is at fault. Command line: exit code 3.
class InputError : public std::runtime_error {
public:
    InputError(const std::string& file, const std::string& field, const std::string& expected,
               const std::string& found)
        : std::runtime_error(file + ": " + (field.empty() ? "" : field + ": ") + "expected " + expected +
                             ", found " + found) {}
};

// A request that is well formed but asks for something impossible, such as a display that the wall does
// not have. Command line: exit code 2. Network: 422.
class UsageError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace curvewall
