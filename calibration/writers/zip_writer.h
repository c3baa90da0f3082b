#pragma once
// ZIP archives from memory.

#include <string>
#include <vector>

namespace curvewall {

struct ZipMember {
    std::string name;
    std::string bytes;
};

// Throws std::runtime_error where it cannot be written.
void writeZip(const std::string& path, const std::vector<ZipMember>& members);

}  // namespace curvewall
