#pragma once
// Whole files in memory.

#include <cstdint>
#include <string>
#include <vector>

namespace curvewall {

// Throws InputError that names `path`.
std::vector<uint8_t> readFile(const std::string& path);

}  // namespace curvewall
