#include "renderer/scene/load_scene.h"

#include "calibration/errors.h"
#include "renderer/scene/city.h"
#include "renderer/scene/gltf_reader.h"
#include "renderer/scene/obj_reader.h"
#include "renderer/scene/room.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <string_view>
#include <vector>

namespace curvewall {
namespace {

std::vector<std::string_view> splitAtColons(std::string_view name) {
    std::vector<std::string_view> parts;
    for (size_t begin = 0; begin <= name.size();) {
        const size_t end = std::min(name.find(':', begin), name.size());
        parts.push_back(name.substr(begin, end - begin));
        begin = end + 1;
    }
    return parts;
}

uint32_t numberFrom(std::string_view text, const std::string& name, const std::string& what) {
    uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (text.empty() || error != std::errc{} || end != text.data() + text.size())
        throw UsageError("scene \"" + name + "\": " + what + ", not \"" + std::string(text) + "\"");
    return number;
}

Scene cityFromName(const std::string& name) {
    const std::vector<std::string_view> parts = splitAtColons(name);
    if (parts.size() > 3) throw UsageError("scene \"" + name + "\": the form is city[:triangles[:seed]]");
    const std::string countRange = "the number of triangles is a whole number from " +
                                   std::to_string(kMinCityTriangles) + " to " +
                                   std::to_string(kMaxCityTriangles);
    uint32_t triangles = kDefaultCityTriangles;
    uint32_t seed = 1;
    if (parts.size() > 1) triangles = numberFrom(parts[1], name, countRange);
    if (parts.size() > 2) seed = numberFrom(parts[2], name, "the seed is a whole number below 2^32");
    if (triangles < kMinCityTriangles || triangles > kMaxCityTriangles)
        throw UsageError("scene \"" + name + "\": " + countRange);
    return makeCity(triangles, seed);
}

}  // namespace

bool isBuiltInScene(const std::string& name) {
    return name == "room" || name == "city" || name.starts_with("room:") || name.starts_with("city:");
}

Scene loadScene(const std::string& name) {
    if (name == "room") return makeRoom();
    if (name.starts_with("room:")) throw UsageError("scene \"" + name + "\": \"room\" takes no parameters");
    if (isBuiltInScene(name)) return cityFromName(name);

    std::error_code error;
    if (!std::filesystem::is_regular_file(name, error))
        throw InputError(name, "", "a .gltf, .glb or .obj file, \"room\" or \"city[:triangles[:seed]]\"",
                         std::filesystem::exists(name, error) ? "no regular file" : "no such file");
    std::string extension = std::filesystem::path(name).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".gltf" || extension == ".glb") return readGltf(name);
    if (extension == ".obj") return readObj(name);
    throw InputError(name, "", "a file name that ends in .gltf, .glb or .obj",
                     extension.empty() ? "no extension" : "\"" + extension + "\"");
}

}  // namespace curvewall
