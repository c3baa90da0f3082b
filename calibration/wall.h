#pragma once
// One installation: its eye and its displays.

#include "calibration/assumptions.h"
#include "calibration/blending/blend.h"
#include "calibration/projections/projection.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace curvewall {

struct Display {
    std::string name;
    glm::ivec2 sizePx{0};
    std::string projectionType;             // as the wall file writes it: "cylinder", "planar", ...
    ProjectionPtr projection{};             // seen from the wall's eye
    BlendMapsPtr blend{};                   // null where it does nothing; the same for every eye
    std::vector<Assumption> assumptions{};  // what its file leaves open
    std::vector<std::string> warnings{};    // where its file contradicts itself
};

struct Wall {
    std::string name;
    glm::dvec3 eyeM{0};       // in wall coordinates
    glm::vec3 background{0};  // linear light; shown where nothing is drawn
    std::vector<Display> displays{};
    std::vector<std::string> files{};  // paths of all that was read for it
};

using WallPtr = std::shared_ptr<const Wall>;

// The wall for another eye, in wall coordinates; displays that are the same from everywhere keep their
// projection. Throws UsageError where that eye cannot see a display.
Wall seenFrom(const Wall& wall, glm::dvec3 eyeM);

// The display of that name, or the first one when the name is empty. Throws UsageError that lists the names.
const Display& findDisplay(const Wall& wall, std::string_view name);

// Whether the display's right border shows what its left border shows, as on a full turn.
bool closesOnItself(const Display& display);

}  // namespace curvewall
