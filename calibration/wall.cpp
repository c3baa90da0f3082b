#include "calibration/wall.h"

#include "calibration/errors.h"

#include <glm/geometric.hpp>

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

bool closesOnItself(const Display& display) {
    const double middle = 0.5 * display.sizePx.y;
    const auto left = display.projection->unproject({0, middle});
    const auto right = display.projection->unproject({display.sizePx.x, middle});
    return left && right && glm::distance(glm::normalize(*left), glm::normalize(*right)) < 1e-9;
}

}  // namespace curvewall
