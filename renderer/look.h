#pragma once
// What a frame shows, whichever method draws it.

namespace curvewall {

enum class Style {
    textured,  // base colour, one sun, ambient
    unlit,     // base colour alone
};

enum class OutputKind {
    color,
    depth,     // distance from the eye, metres; infinity where nothing is drawn
    coverage,  // fragments drawn at each pixel after discard, no depth test
    position,  // eye-relative point shown, wall axes, metres; NaN where nothing is drawn
};

}  // namespace curvewall
