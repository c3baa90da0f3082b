#include "renderer/scene/read_file.h"

#include "calibration/errors.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace curvewall {

std::vector<uint8_t> readFile(const std::string& path) {
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw InputError(path, "", "a readable file", std::strerror(errno));
    std::vector<uint8_t> bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (stream.bad()) throw InputError(path, "", "a readable file", "a read error");
    return bytes;
}

}  // namespace curvewall
