#include "server/library.h"

#include "calibration/errors.h"
#include "calibration/files/json_fields.h"
#include "calibration/readers/wall_reader.h"
#include "renderer/scene/load_scene.h"

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>

namespace curvewall {
namespace {

namespace fs = std::filesystem;

// In the order of their names, so that which of two equal stems wins does not depend on the file system.
std::vector<fs::path> filesIn(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        files.push_back(entry->path());
    std::sort(files.begin(), files.end());
    return files;
}

// Other calibrations need a wall file: their folders are full of maps that are no walls.
bool isWallFile(const fs::path& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return false;
    if (path.extension() == ".mpcdi") return true;
    if (path.extension() != ".json") return false;
    std::ifstream file(path, std::ios::binary);
    const nlohmann::json root = nlohmann::json::parse(file, nullptr, false);
    if (root.is_discarded()) spdlog::warn("{} is left out: it is not JSON", path.string());
    return root.is_object() && root.contains("wall");
}

bool isSceneFile(const fs::path& path) {
    std::error_code error;
    const fs::path extension = path.extension();
    return (extension == ".gltf" || extension == ".glb" || extension == ".obj") &&
           fs::is_regular_file(path, error);
}

void addSceneFile(const fs::path& path, Library& library) {
    const std::string name = path.stem().string();
    if (isBuiltInScene(name))
        spdlog::warn("{} is left out: {} is a built-in scene", path.string(), name);
    else if (const auto [entry, added] = library.sceneFiles.emplace(name, path.string()); !added)
        spdlog::warn("{} is left out: {} has the same name", path.string(), entry->second);
}

void addSceneFiles(const fs::path& folder, Library& library) {
    for (const fs::path& path : filesIn(folder)) {
        if (isSceneFile(path)) addSceneFile(path, library);
        std::error_code error;
        if (!fs::is_directory(path, error)) continue;
        for (const fs::path& inner : filesIn(path))
            if (isSceneFile(inner)) addSceneFile(inner, library);
    }
}

// "city:N" and "city:N:seed"; what is wrong with other parameters is for the scene's maker to say.
void checkCitySize(std::string_view name, uint64_t maxTriangles) {
    constexpr std::string_view kPrefix = "city:";
    if (!name.starts_with(kPrefix)) return;
    const std::string_view count =
        name.substr(kPrefix.size(), name.find(':', kPrefix.size()) - kPrefix.size());
    uint64_t triangles = 0;
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), triangles);
    const bool isNumber = error == std::errc() && end == count.data() + count.size();
    if (!isNumber || triangles > maxTriangles)
        throw UsageError("scene: expected a city of at most " + std::to_string(maxTriangles) +
                         " triangles, found " + describe(std::string(count)));
}

}  // namespace

Library openLibrary(const std::string& wallsFolder, const std::string& scenesFolder,
                    uint64_t maxCityTriangles) {
    if (!fs::is_directory(wallsFolder)) throw InputError(wallsFolder, "", "a folder of wall files", "none");
    Library library;
    library.maxCityTriangles = maxCityTriangles;
    for (const fs::path& path : filesIn(wallsFolder)) {
        if (!isWallFile(path)) continue;
        try {
            auto wall = std::make_shared<const Wall>(readWall(path.string()));
            for (const Display& display : wall->displays)
                for (const std::string& warning : display.warnings)
                    spdlog::warn("{}: {}: {}", path.string(), display.name, warning);
            if (const auto [entry, added] = library.walls.emplace(path.stem().string(), std::move(wall));
                !added)
                spdlog::warn("{} is left out: another wall has the same name", path.string());
        } catch (const std::exception& error) {
            spdlog::warn("{} is left out: {}", path.string(), error.what());
        }
    }
    addSceneFiles(scenesFolder, library);
    return library;
}

std::vector<std::string> wallNames(const Library& library) {
    std::vector<std::string> names;
    for (const auto& [name, wall] : library.walls) names.push_back(name);
    return names;
}

std::vector<std::string> sceneNames(const Library& library) {
    std::vector<std::string> names{"city", "room"};
    for (const auto& [name, path] : library.sceneFiles) names.push_back(name);
    return names;
}

WallPtr findWall(const Library& library, std::string_view name) {
    const auto found = library.walls.find(name);
    if (found == library.walls.end())
        throw UsageError("wall: expected one that GET /v1/walls lists, found " + describe(std::string(name)));
    return found->second;
}

std::string findScene(const Library& library, std::string_view name) {
    if (const auto found = library.sceneFiles.find(name); found != library.sceneFiles.end())
        return found->second;
    if (!isBuiltInScene(std::string(name)))
        throw UsageError("scene: expected one that GET /v1/scenes lists, found " +
                         describe(std::string(name)));
    checkCitySize(name, library.maxCityTriangles);
    return std::string(name);
}

}  // namespace curvewall
