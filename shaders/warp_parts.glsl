// Into which parts does vertex-warp divide a triangle? Those whose every edge is seen under less than 45 degrees and is
// short enough for the tessellator. Whether an edge is divided follows from its ends alone, so that neighbours divide it
// alike and their parts meet without gaps. Parts that show nothing are left out; so are those around a direction that
// positions jump at.

#include "scene_geometry.glsl"
#include "warp_geometry.glsl"

const uint ALL_PIECES = 0xffffffffu;
const uint SEEN_FROM_BEHIND = 0x80000000u;  // a triangle's facing, beside its index
const float WIDEST_COSINE = 0.70710678;
const float MOST_GAP_PX = 1.0;  // left open where parts can be no finer

struct RayTriangle {
    vec3 a, b, c;  // from the eye to the corners
    float facing;  // det(a, b, c): positive seen from behind
};

RayTriangle rayTriangleAt(uint triangle) {
    vec3 a = rayToVertex(corners[3u * triangle]), b = rayToVertex(corners[3u * triangle + 1u]),
         c = rayToVertex(corners[3u * triangle + 2u]);
    // As in piece_coverage.glsl.
    return RayTriangle(a, b, c, dot(a, cross(b - a, c - a)));
}

float cosineBetween(vec3 a, vec3 b) { return dot(a, b) / max(length(a) * length(b), 1e-30); }

// Whether an edge goes more than 45 degrees around a direction that positions jump at: straight on the screen, it would
// sweep across what lies between (the malevolent behaviour of large triangles that Oros ends with). One that ends there does.
bool turnsFarAround(vec4 jump, vec3 a, vec3 b) {
    float alongA = dot(jump.xyz, a), alongB = dot(jump.xyz, b);
    vec3 besideA = a - alongA * jump.xyz, besideB = b - alongB * jump.xyz;
    bool isAhead = alongA > 0.0 || alongB > 0.0;
    return isAhead && dot(besideA, besideB) <= WIDEST_COSINE * length(besideA) * length(besideB);
}

bool turnsFar(vec3 a, vec3 b) { return turnsFarAround(torn[0], a, b) || turnsFarAround(torn[1], a, b); }

bool isLong(vec3 a, vec3 b, vec2 pxA, vec2 pxMiddle, vec2 pxB) {
#ifdef PROJECTIVE
    return false;  // straight whatever its length
#else
    if (cosineBetween(a, b) < WIDEST_COSINE || turnsFar(a, b)) return true;
    float askedPx = finish.y;
    if (askedPx == 0.0) return false;
    vec2 lengthsPx = edgeLengthsPx(pxA, pxMiddle, pxB);
    // Equal steps must be about equally long.
    return lengthsPx.x > longestEdgePx() || (lengthsPx.x > 4.0 * lengthsPx.y && lengthsPx.x > 2.0 * askedPx);
#endif
}

// A part of the current triangle, and where its corners and the middles of its edges land.
struct Part {
    vec3 a, b, c;
    vec2 pxA, pxB, pxC, pxAb, pxBc, pxCa;
};

struct PartCorners {
    uvec2 corners[3];  // of a part, for weightsOf()
};
PartCorners taken;  // of the part that is taken

bool isPartBesideDisplay(Part p) {
    vec3 a = normalize(p.a), b = normalize(p.b), c = normalize(p.c);
    vec3 middle = a + b + c;
    float apart = length(middle);
    if (!(apart > 1e-3)) return false;
    middle /= apart;
    float cosine = min(min(dot(middle, a), dot(middle, b)), dot(middle, c));
    if (cosine <= 0.0) return false;
    return isBesideDisplay(middle, sqrt(max(1.0 - cosine * cosine, 0.0)), cosine);
}

bool isAround(vec4 jump, Part p, float facing) {
    vec3 axis = facing < 0.0 ? -jump.xyz : jump.xyz;
    return jump.w > 0.0 && dot(axis, cross(p.a, p.b - p.a)) >= 0.0 && dot(axis, cross(p.b, p.c - p.b)) >= 0.0 &&
           dot(axis, cross(p.c, p.a - p.c)) >= 0.0 && dot(jump.xyz, p.a + p.b + p.c) > 0.0;
}

// The box of a part on the screen, with what its edges may bulge, counted on from its first corner where the map repeats.
struct ScreenBox {
    vec2 least, most;
    bool isTorn;  // it goes around a pole
};

ScreenBox boxOf(Part p) {
    vec2 ab = wayOnScreen(p.pxA, p.pxB), bc = wayOnScreen(p.pxB, p.pxC), ca = wayOnScreen(p.pxC, p.pxA);
    vec2 around = abs(ab + bc + ca);
    bool isTorn = (size.z > 0.0 && around.x > 0.5 * size.z) || (size.w > 0.0 && around.y > 0.5 * size.w);
    vec2 midAb = wayOnScreen(p.pxA, p.pxAb), midBc = wayOnScreen(p.pxA, p.pxBc), midCa = wayOnScreen(p.pxA, p.pxCa);
    vec2 least = min(min(min(vec2(0.0), ab), min(-ca, midAb)), min(midBc, midCa));
    vec2 most = max(max(max(vec2(0.0), ab), max(-ca, midAb)), max(midBc, midCa));
    vec2 bulge = 0.25 * (most - least) + 1.0 / 16.0;
    return ScreenBox(p.pxA + least - bulge, p.pxA + most + bulge, isTorn);
}

// Whether a part shows no more than a hair around a pole that is the picture's border: to meet there, parts would have no end.
bool isAtPole(Part p) {
    const float HAIR_PX = 1.0 / 64.0;
    vec2 least = min(min(p.pxA, p.pxB), p.pxC), most = max(max(p.pxA, p.pxB), p.pxC);
    return (size.z > 0.0 && (most.y < HAIR_PX || least.y > size.y - HAIR_PX)) ||
           (size.w > 0.0 && (most.x < HAIR_PX || least.x > size.x - HAIR_PX));
}

// How often, and from where on, the map repeats within the display along an axis; none: it does not.
ivec2 turnsWithin(float least, float most, float extentPx, float turnPx) {
    if (turnPx == 0.0) return most < 0.0 || least > extentPx ? ivec2(0) : ivec2(0, 1);
    int begin = int(ceil(-most / turnPx)), end = int(floor((extentPx - least) / turnPx)) + 1;
    begin = max(begin, -TURN_BIAS);
    return ivec2(begin, clamp(end - begin, 0, TURN_BIAS - begin));
}

// Why walk() has not all of a triangle's parts; renderer/coverage.cpp says so. Of several reasons the largest counts.
const uint TOO_MANY_PARTS = 1u, TOO_COARSE_PARTS = 2u;
uint refusal = 0u;
void take(uint piece, uint nth);  // what the includer does with the nth part

// No map repeats along both.
ivec2 turnsOf(ScreenBox box) {
    ivec2 across = turnsWithin(box.least.x, box.most.x, size.x, size.z);
    ivec2 down = turnsWithin(box.least.y, box.most.y, size.y, size.w);
    if (across.y == 0 || down.y == 0) return ivec2(0);
    return size.w > 0.0 ? down : across;
}

// Of the edges that have to be divided, the largest is, which halves a part as seen from the eye. But those to far away
// count more than those nearby: an edge from near the eye to far away would use up the weights with its many halves.
float sizeOfEdge(vec3 a, vec3 b) {
    vec3 seen = normalize(a) - normalize(b);
    return distance(a, b) * dot(seen, seen);
}

// Points are sums of a triangle's corners with their roundings, and edges not much longer than those turn any way. How far
// the largest of what is summed up for the point at `at` lies, at most: where one corner is near and another far away, that
// is far less than the farther of them. At the pole of a map that repeats nothing so small is left (see isAtPole); straight
// behind a round one it would be seen all along the rim.
float finestAt(vec3 nearness, vec3 at) {
    precise float sum = at.x * nearness.x + at.y * nearness.y + at.z * nearness.z;
    return ldexp(1.0 / sum, size.z > 0.0 || size.w > 0.0 ? -23 : -20);
}

// Whether an edge can be halved, and is long enough for it.
bool hasMiddle(uvec2 weightsA, uvec2 weightsB, vec3 a, vec3 b, float finest) {
    return ((weightsA + weightsB) & 1u) == uvec2(0u) && distance(a, b) > finest;
}

// Whether the eye is surely off a triangle's plane, by more than what is cut: others are seen edge-on, as a line at most.
bool isOffPlane(RayTriangle t) {
    vec3 ab = t.b - t.a, ac = t.c - t.a;
    float roundings = ldexp(dot(abs(t.a), abs(ab.yzx * ac.zxy) + abs(ab.zxy * ac.yzx)), -22);
    vec3 normal = abs(cross(ab, ac));  // whose length might be more than single precision has
    return abs(t.facing) > max(roundings, finish.z / finish.x * max(normal.x, max(normal.y, normal.z)));
}

// How much the display shows between where a point lands and where its side of a direction that positions jump at does.
float shownBesidePx(vec4 jump, vec3 at, vec2 px) {
    vec3 beside = at - dot(jump.xyz, at) * jump.xyz;
    vec2 end = pixelsOf(jump.xyz + beside * (1e-6 / max(length(beside), 1e-30)));
    // Poles of maps that repeat are whole lines.
    vec2 shown = abs(clamp(px, vec2(0.0), size.xy) - clamp(end, vec2(0.0), size.xy));
    if (size.z > 0.0) return shown.y;
    if (size.w > 0.0) return shown.x;
    // Straight behind a round one is a circle. On which side of it a point so close by lies its roundings may tell.
    if (px != clamp(px, vec2(0.0), size.xy)) return 0.0;
    vec2 middle = pixelsOf(-jump.xyz);
    return abs(distance(px, middle) - distance(end, middle));
}

// How wide a gap is at an edge that turns far and cannot be divided.
float gapBesidePx(vec4 jump, vec3 a, vec3 b, vec2 pxA, vec2 pxB) {
    return turnsFarAround(jump, a, b) ? max(shownBesidePx(jump, a, pxA), shownBesidePx(jump, b, pxB)) : 0.0;
}

float gapAtEdgePx(vec3 a, vec3 b, vec2 pxA, vec2 pxB) {
    return max(gapBesidePx(torn[0], a, b, pxA, pxB), gapBesidePx(torn[1], a, b, pxA, pxB));
}

// How wide a gap is where a part is left out that cannot be divided. Where it is only a line, it may seem to go around a pole.
float gapPx(Part p, ScreenBox box, bool isWide) {
    float gap = max(max(gapAtEdgePx(p.a, p.b, p.pxA, p.pxB), gapAtEdgePx(p.b, p.c, p.pxB, p.pxC)),
                    gapAtEdgePx(p.c, p.a, p.pxC, p.pxA));
    bool isBeside = box.isTorn || turnsOf(box).y == 0;
    return isWide && !isBeside ? max(gap, length(box.most - box.least)) : gap;
}

// Takes the parts of the triangle, `most` of them, and counts them. `begin` and `end` are those of a piece tree.
uint walk(RayTriangle t, uint begin, uint end, uint most) {
    const PartCorners WHOLE = PartCorners(uvec2[](uvec2(WEIGHT_STEPS, 0u), uvec2(0u, WEIGHT_STEPS), uvec2(0u)));
    const int MOST_OPEN = 96;  // each division leaves one for later, and halves an edge
    const int MOST_STEPS = 60000;
    PartCorners open[MOST_OPEN];
    open[0] = WHOLE;
    int openCount = 1;
    vec3 nearness = 1.0 / max(vec3(length(t.a), length(t.b), length(t.c)), 1e-30);
    uint count = 0u;
    ivec2 turns = ivec2(0);  // of the part in hand: the next that is taken, and how many are left
    // One loop, for llvmpipe (Mesa 22.3) ends all loops of a shader once they have gone round 65,535 times together.
    for (int step = 0; step < MOST_STEPS && (openCount > 0 || turns.y > 0) && count < most; ++step) {
        if (turns.y > 0) {
            take(uint(turns.x + TURN_BIAS) | (taken == WHOLE ? 0u : IS_DIVIDED), count++);
            turns += ivec2(1, -1);
            continue;
        }
        uvec2 part[3] = open[--openCount].corners;
        Part p;
        p.a = pointWithin(t.a, t.b, t.c, weightsOf(part[0]));
        p.b = pointWithin(t.a, t.b, t.c, weightsOf(part[1]));
        p.c = pointWithin(t.a, t.b, t.c, weightsOf(part[2]));
        if (isPartBesideDisplay(p)) continue;
        bool isWide = min(min(cosineBetween(p.a, p.b), cosineBetween(p.b, p.c)), cosineBetween(p.c, p.a)) < WIDEST_COSINE;
#ifdef PROJECTIVE
        ScreenBox box = ScreenBox(vec2(0.0), size.xy, false);
        isWide = false;
#else
        p.pxA = pixelsOf(p.a);
        p.pxB = pixelsOf(p.b);
        p.pxC = pixelsOf(p.c);
        p.pxAb = pixelsOf(pointBetween(p.a, p.b, 1.0, 1.0));
        p.pxBc = pixelsOf(pointBetween(p.b, p.c, 1.0, 1.0));
        p.pxCa = pixelsOf(pointBetween(p.c, p.a, 1.0, 1.0));
        ScreenBox box = boxOf(p);
        if (isAround(torn[0], p, t.facing) || isAround(torn[1], p, t.facing)) box.isTorn = true;
        if (isAtPole(p) || (!isWide && !box.isTorn && turnsOf(box).y == 0)) continue;
        // Around a pole only the distance from it counts.
        if (!isWide && box.isTorn && size.z > 0.0 && (box.most.y < 0.0 || box.least.y > size.y)) continue;
        if (!isWide && box.isTorn && size.w > 0.0 && (box.most.x < 0.0 || box.least.x > size.x)) continue;
#endif
        float finestA = finestAt(nearness, weightsOf(part[0])), finestB = finestAt(nearness, weightsOf(part[1])),
              finestC = finestAt(nearness, weightsOf(part[2]));
        vec3 sizes = vec3(
            hasMiddle(part[0], part[1], p.a, p.b, max(finestA, finestB)) && isLong(p.a, p.b, p.pxA, p.pxAb, p.pxB) ? sizeOfEdge(p.a, p.b) : 0.0,
            hasMiddle(part[1], part[2], p.b, p.c, max(finestB, finestC)) && isLong(p.b, p.c, p.pxB, p.pxBc, p.pxC) ? sizeOfEdge(p.b, p.c) : 0.0,
            hasMiddle(part[2], part[0], p.c, p.a, max(finestC, finestA)) && isLong(p.c, p.a, p.pxC, p.pxCa, p.pxA) ? sizeOfEdge(p.c, p.a) : 0.0);
        float largest = max(max(sizes.x, sizes.y), sizes.z);
        if (largest == 0.0 || openCount + 2 > MOST_OPEN) {
            taken.corners = part;
            // What still turns far is too small to be divided, and would be seen far from where it is.
            bool isDrawn = !isWide && !box.isTorn && !turnsFar(p.a, p.b) && !turnsFar(p.b, p.c) && !turnsFar(p.c, p.a);
            if (isDrawn) {
                turns = turnsOf(box);
            } else if (gapPx(p, box, isWide) > MOST_GAP_PX && isOffPlane(t)) {
                refusal = max(refusal, largest == 0.0 ? TOO_COARSE_PARTS : TOO_MANY_PARTS);
            }
            continue;
        }
        int from = largest == sizes.x ? 0 : largest == sizes.y ? 1 : 2, to = (from + 1) % 3;
        uvec2 middle = (part[from] + part[to]) >> 1u;
        PartCorners first = PartCorners(part), second = first;
        first.corners[from] = middle;
        second.corners[to] = middle;
        open[openCount++] = first;
        open[openCount++] = second;
    }
    if ((openCount > 0 || turns.y > 0) && count < most) refusal = max(refusal, TOO_MANY_PARTS);
    return count;
}
