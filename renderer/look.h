#pragma once
// What a frame shows, whichever method draws it.

namespace curvewall {

enum class Style {
    textured,   // base colour, one sun, ambient
    unlit,      // base colour alone
    wireframe,  // textured, with every triangle's edges
    penAndInk,  // hatching for tones, outlines where shapes end or fold
};

enum class OutputKind {
    color,
    depth,     // distance from the eye, metres; infinity where nothing is drawn
    coverage,  // fragments drawn at each pixel after discard, no depth test
    position,  // eye-relative point shown, wall axes, metres; NaN where nothing is drawn
};

// Whether lines are drawn along edges, of widths in pixels of the picture drawn.
constexpr bool drawsEdges(Style style, OutputKind output) {
    return output == OutputKind::color && (style == Style::wireframe || style == Style::penAndInk);
}

}  // namespace curvewall
