#pragma once
// Geometry and displays that break renderers, in families from easy to impossible.

#include "calibration/wall.h"
#include "renderer/camera.h"
#include "renderer/scene/scene.h"

#include <functional>
#include <string>
#include <vector>

namespace curvewall {

// One scene on the first display of a wall.
struct HardCase {
    WallPtr wall;
    ScenePtr scene;
    Camera camera{};
};

struct HardCaseFamily {
    std::string name;            // in words, also the stem of files
    std::string what;            // what is hard about it, and where it is met in practice
    std::string parameter;       // "distance of the plane from the eye, m"
    std::vector<double> values;  // from easy to impossible
    size_t pictured = 0;         // the value that is worth a picture
    // `sizePx` is the larger side of the display but where the size is what the family is about. Throws
    // UsageError or InputError where the wall itself is refused.
    std::function<HardCase(double value, int sizePx)> make;
};

// In the order in which they are told.
std::vector<HardCaseFamily> hardCaseFamilies();

}  // namespace curvewall
