// Lines and strokes of the styles wireframe and pen-and-ink, once for the shaders and for the reference. Legal GLSL and
// legal C++ under GLM: `f` on every literal, no swizzles, no out parameters. C++ includes it through
// renderer/line_styles.h. All lengths are pixels of the picture that is drawn; `footprintPx` is the side of the square
// that one sample stands for.

const float kWireWidthPx = 2.0f;
const float kOutlineWidthPx = 2.0f;
// Hatching lines are this far apart along a row, so that they close the ring of a full turn wherever the display's width
// is a multiple of it; most are.
const float kHatchPeriodPx = 10.0f;
const float kHatchWidthPx = 1.6f;

// Distance from the line where f is 0, for an f that is affine on the screen.
SHARED_FN float distanceToLinePx(float f, vec2 gradientPerPx) { return abs(f) / max(length(gradientPerPx), 1e-18f); }

// Share of the footprint that lies on a line this wide. The sum of it across a line is the line's width.
SHARED_FN float strokeCoverage(float distancePx, float widthPx, float footprintPx) {
    float reach = 0.5f * footprintPx, halfWidthPx = 0.5f * widthPx;
    float covered = min(distancePx + reach, halfWidthPx) - max(distancePx - reach, -halfWidthPx);
    return clamp(covered / footprintPx, 0.0f, 1.0f);
}

// Width of the line around an edge, half of it on each side. Of a silhouette only one side is seen, so that this one takes
// the whole. A border with nothing across may be one, or lie on the middle of another triangle's edge: it has one half.
SHARED_FN float wireWidthPx(bool silhouette) { return silhouette ? 2.0f * kWireWidthPx : kWireWidthPx; }

// Outlines are where the shape ends or folds, not where a surface was cut into triangles.
SHARED_FN float outlineWidthPx(bool silhouette, bool fold) {
    if (silhouette) return 2.0f * kOutlineWidthPx;
    return fold ? kOutlineWidthPx : 0.0f;
}

SHARED_FN vec3 wireframeColor(vec3 surface, float line) { return mix(surface, vec3(1.0f), line); }

// Parallel lines a period apart along a row; `slope` +1 rises to the right, -1 falls, `phase` is in periods.
SHARED_FN float parallelLines(vec2 px, float slope, float phase, float widthPx, float footprintPx) {
    float across = (px.x + slope * px.y) / kHatchPeriodPx + phase;
    float distancePx = abs(fract(across) - 0.5f) * kHatchPeriodPx * 0.70710678f;
    return strokeCoverage(distancePx, widthPx, footprintPx);
}

// Hatching for a surface of this darkness, 0 to 1: first lines far apart that swell, then lines between them, then
// those that cross.
SHARED_FN float hatching(vec2 px, float darkness, float footprintPx) {
    float paper = 1.0f;
    for (int layer = 0; layer < 4; ++layer) {
        float start = 0.25f + 0.18f * float(layer);
        float widthPx = kHatchWidthPx * clamp((darkness - start) / 0.3f, 0.0f, 1.0f);
        float slope = layer < 2 ? 1.0f : -1.0f;
        float phase = layer == 1 || layer == 3 ? 0.5f : 0.0f;
        paper *= 1.0f - parallelLines(px, slope, phase, widthPx, footprintPx);
    }
    return 1.0f - paper;
}

// Ink on paper. `px` is the place on the display, and the only thing beside the tone that hatching depends on.
SHARED_FN vec3 penAndInkColor(vec3 surface, vec2 px, float outline, float footprintPx) {
    float luminance = dot(surface, vec3(0.2126f, 0.7152f, 0.0722f));
    // The root spreads tones about as evenly as they are seen.
    float darkness = 1.0f - sqrt(clamp(luminance, 0.0f, 1.0f));
    float ink = max(outline, hatching(px, darkness, footprintPx));
    return mix(vec3(1.0f), vec3(0.01f), ink);
}
