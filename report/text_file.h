#pragma once
// What a report consists of, written to files.

#include <string>
#include <string_view>

namespace curvewall {

// Throws std::runtime_error where the file cannot be written.
void writeTextFile(const std::string& path, std::string_view content);

}  // namespace curvewall
