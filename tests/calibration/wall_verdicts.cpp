// Says of every wall file in a folder what the reader says: "NAME<tab>MESSAGE" a line, in the order of the
// names, the message empty where the file is a wall.

#include "calibration/errors.h"
#include "calibration/readers/wall_reader.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

namespace {

std::string verdictOn(const std::string& path) {
    try {
        curvewall::readWall(path);
        return "";
    } catch (const curvewall::InputError& error) {
        return error.what();
    }
}

}  // namespace

int main(int, char** arguments) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(arguments[1]))
        if (entry.path().extension() == ".json") paths.push_back(entry.path());
    std::ranges::sort(paths);
    for (const auto& path : paths)
        std::cout << path.filename().string() << '\t' << verdictOn(path.string()) << '\n';
}
