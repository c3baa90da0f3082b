#include "calibration/wall.h"

#include "calibration/errors.h"

#include <algorithm>

namespace curvewall {

const Display& findDisplay(const Wall& wall, std::string_view name) {
    if (name.empty()) return wall.displays.front();
    const auto found = std::ranges::find(wall.displays, name, &Display::name);
    if (found != wall.displays.end()) return *found;
    std::string names;
    for (const Display& display : wall.displays) names += (names.empty() ? "" : ", ") + display.name;
    throw UsageError("wall \"" + wall.name + "\" has no display \"" + std::string(name) + "\"; it has " +
                     names);
}

}  // namespace curvewall
