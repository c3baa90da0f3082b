// Points of triangles as vertex-warp divides them. Neighbours must agree on every point of their edge to the last bit, so
// whatever belongs to an edge follows from its two ends alone, taken in one order.

#include "screen_position.glsl"

// A part's corners have weights within the triangle that are whole numbers of steps, so that halves are exact. Seen from
// close above, a plane that reaches to the horizon needs that many: what lies straight below takes so small a share of it.
const uint WEIGHT_STEPS = 1u << 31;
const uint IS_DIVIDED = 0x40000000u;  // a part that is not the whole triangle, beside its turn of the map
const int TURN_BIAS = 8;
// Of an edge by the tessellator. A part with one long and one short edge gets as many triangles as one with three long
// edges, which costs more than to divide it first; but parts that are small themselves only cost. With 64 divisions,
// llvmpipe (Mesa 22.3) loses triangles.
const float FEW_DIVISIONS = 8.0, MOST_DIVISIONS = 32.0;
const float SMALL_PART_PX = 64.0;

bool comesBefore(vec3 a, vec3 b) {
    if (a.x != b.x) return a.x < b.x;
    if (a.y != b.y) return a.y < b.y;
    return a.z < b.z;
}

// Of each end at what share it is in the point of the edge that the eye sees at `atA` to `atB` between them: equal steps
// of that are nearly equal steps on the screen, however steeply the edge runs away.
vec2 sharesBetween(vec3 a, vec3 b, float atA, float atB) {
    precise float ofA = atA * length(b), ofB = atB * length(a);
    precise float sum = ofA + ofB;
    return vec2(ofA, ofB) / max(sum, 1e-30);
}

vec3 pointBetween(vec3 a, vec3 b, float atA, float atB) {
    bool swapped = comesBefore(b, a);
    vec3 first = swapped ? b : a, second = swapped ? a : b;
    vec2 shares = sharesBetween(first, second, swapped ? atB : atA, swapped ? atA : atB);
    precise vec3 point = shares.x * first + shares.y * second;
    return point;
}

// The same for all three corners, without a promise to neighbours.
vec3 sharesWithin(vec3 a, vec3 b, vec3 c, vec3 at) {
    float ofA = length(a), ofB = length(b), ofC = length(c);
    vec3 shares = at * vec3(ofB * ofC, ofC * ofA, ofA * ofB);
    return shares / max(shares.x + shares.y + shares.z, 1e-30);
}

vec3 pointWithin(vec3 a, vec3 b, vec3 c, vec3 at) {
    if (at.x == 0.0) return at.y == 0.0 ? c : at.z == 0.0 ? b : pointBetween(b, c, at.y, at.z);
    if (at.y == 0.0) return at.z == 0.0 ? a : pointBetween(c, a, at.z, at.x);
    if (at.z == 0.0) return pointBetween(a, b, at.x, at.y);
    vec3 shares = sharesWithin(a, b, c, at);
    return shares.x * a + shares.y * b + shares.z * c;
}

// The weights of a part's corner, of which two are kept.
vec3 weightsOf(uvec2 corner) {
    return vec3(uvec3(corner, WEIGHT_STEPS - corner.x - corner.y)) * (1.0 / float(WEIGHT_STEPS));
}

// How long the edges of a part may be on the screen.
float longestEdgePx() { return clamp(SMALL_PART_PX, FEW_DIVISIONS * finish.y, MOST_DIVISIONS * finish.y); }

vec2 pixelsOf(vec3 ray) {
    vec3 h = screenPosition(ray);
    return h.xy / h.z;
}

// The way from one position to another, the shorter one where the map repeats.
vec2 wayOnScreen(vec2 from, vec2 to) {
    vec2 way = to - from;
    if (size.z > 0.0) way.x -= size.z * round(way.x / size.z);
    if (size.w > 0.0) way.y -= size.w * round(way.y / size.w);
    return way;
}

// What lies far outside counts as just outside.
vec2 nearDisplay(vec2 px) {
    vec2 margin = 0.25 * size.xy;
    vec2 inside = clamp(px, -margin, size.xy + margin);
    return vec2(size.z > 0.0 ? px.x : inside.x, size.w > 0.0 ? px.y : inside.y);
}

// Twice the longer half of an edge on the screen, and twice the shorter, from where its ends and its middle land.
vec2 edgeLengthsPx(vec2 from, vec2 middle, vec2 to) {
    float one = length(wayOnScreen(nearDisplay(middle), nearDisplay(from)));
    float other = length(wayOnScreen(nearDisplay(middle), nearDisplay(to)));
    return 2.0 * vec2(max(one, other), min(one, other));
}
