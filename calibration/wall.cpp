#include "calibration/wall.h"

#include "calibration/errors.h"

#include <algorithm>

namespace curvewall {

Wall seenFrom(const Wall& wall, glm::dvec3 eyeM) {
    Wall moved = wall;
    moved.eyeM = eyeM;
    for (Display& display : moved.displays) {
        if (!display.projection->dependsOnEye()) continue;
        try {
            display.projection = display.projection->seenFrom(eyeM);
        } catch (const UsageError& error) {
            throw UsageError("display \"" + display.name + "\": " + error.what());
        }
    }
    return moved;
}

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
