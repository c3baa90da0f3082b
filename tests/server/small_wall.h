#pragma once
// A wall for tests of the daemon.

#include <string_view>

namespace curvewall {

// A wall file of one cylinder that is quick to render.
inline constexpr std::string_view kSmallWall = R"({
    "wall": "small cylinder", "eye": [0, 0, 0],
    "displays": [ { "name": "front", "size": [320, 240],
                    "projection": { "type": "cylinder", "radius": 2.0, "arc_deg": 180, "height": 4.0 } } ] })";

}  // namespace curvewall
