// What vertex-warp knows of a display; renderer/screen_map.h fills it. Not every kind of map reads everything.

layout(std140, binding = 0) uniform ScreenMap {
    vec4 displayFromWall[3];  // rows; PROJECTIVE: homogeneous pixels from a ray
    vec4 eyeOnSurface;        // CYLINDER, ON_SPHERE: the eye in the display's frame, from the surface's middle; its radius
    vec4 lensOnSurface;       // ON_SPHERE: the lens likewise
    vec4 pixels;              // pixels = xy + zw * the formula's position
    vec4 limit;  // RADIAL, PINHOLE: the angle up to which the formula is used, the radius there, its slope from there on
    vec4 terms[3];            // coefficients of a polynomial or of a pinhole
    vec4 tilt[3];             // PINHOLE: rows
    vec4 tableBox;            // TABLE: the chart's least position, nodes a unit of it
    vec4 beyondTable;         // TABLE: columns of pixels from what a chart position lies beside the table
    vec4 seenCone;            // holds all that the display shows: axis, wall axes, length one, and cosine of half its width
    vec4 torn[2];             // directions that positions jump at, wall axes, length one; w: 1, or 0 where there is none
    vec4 size;                // of the display, px; then how many px the map repeats after along x and along y, 0 for never
    // 1 / distance to the wall; the length of edges that is asked for, px, or 0; the share of that distance that is cut
    vec4 finish;
};

// Nothing within `sine` and `cosine` of the direction, which is not further around it than a quarter turn, is shown.
bool isBesideDisplay(vec3 direction, float sine, float cosine) {
    float halfSine = sqrt(max(1.0 - seenCone.w * seenCone.w, 0.0));
    if (cosine <= -seenCone.w) return false;  // together they are half a turn or more
    return dot(direction, seenCone.xyz) < seenCone.w * cosine - halfSine * sine;
}
