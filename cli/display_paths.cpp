#include "cli/display_paths.h"

#include <filesystem>

namespace curvewall {

std::string pathForDisplay(const std::string& path, const std::string& display, bool severalDisplays) {
    constexpr std::string_view kPlaceholder = "{display}";
    std::string replaced = path;
    for (size_t at = 0; (at = replaced.find(kPlaceholder, at)) != std::string::npos; at += display.size())
        replaced.replace(at, kPlaceholder.size(), display);
    const bool isNamed = path.find(kPlaceholder) != std::string::npos;
    if (isNamed || path.empty() || !severalDisplays) return replaced;
    std::filesystem::path named(path);
    named.replace_filename(named.stem().string() + "-" + display + named.extension().string());
    return named.string();
}

std::vector<const Display*> chosenDisplays(const Wall& wall, const std::string& name) {
    if (!name.empty()) return {&findDisplay(wall, name)};
    std::vector<const Display*> all;
    for (const Display& display : wall.displays) all.push_back(&display);
    return all;
}

}  // namespace curvewall
