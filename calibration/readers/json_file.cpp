#include "calibration/readers/json_file.h"

#include <filesystem>
#include <fstream>
#include <iterator>

namespace curvewall {

std::string readText(const std::string& path, const std::string& expected) {
    std::error_code error;
    std::ifstream file(path, std::ios::binary);
    // A directory opens like a file and throws when it is read.
    if (!file || std::filesystem::is_directory(path, error))
        throw InputError(path, "", expected, "nothing readable");
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace curvewall
