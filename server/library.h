#pragma once
// The walls and scenes that a client may name. A name is looked up here and never becomes a path.

#include "calibration/wall.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace curvewall {

// Does not change after it was opened, so any thread may read it.
struct Library {
    std::map<std::string, WallPtr, std::less<>> walls;
    std::map<std::string, std::string, std::less<>> sceneFiles;  // name to path; built-in scenes are not here
    uint64_t maxCityTriangles = 0;
};

// Walls are the *.json files that are objects with the key "wall", scenes the .gltf, .glb and .obj files of
// the folder and of its subfolders, one level deep; both go by file stem. What cannot be used is left out
// with a warning in the log. A folder that does not exist holds nothing.
Library openLibrary(const std::string& wallsFolder, const std::string& scenesFolder,
                    uint64_t maxCityTriangles);

std::vector<std::string> wallNames(const Library& library);
std::vector<std::string> sceneNames(const Library& library);  // built-in scenes first

// Both throw UsageError for a name that is not in the library. findScene answers what loadScene takes.
WallPtr findWall(const Library& library, std::string_view name);
std::string findScene(const Library& library, std::string_view name);

}  // namespace curvewall
