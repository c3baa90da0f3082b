#pragma once
// Where the names in a wall file lead.

#include <filesystem>
#include <string>
#include <vector>

namespace curvewall {

struct WallFolder {
    std::filesystem::path path;       // of the wall file: what it names is relative to it
    std::vector<std::string>& files;  // gets the path of each file that is found
};

}  // namespace curvewall
