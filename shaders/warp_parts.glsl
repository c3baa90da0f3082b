// Into which parts does vertex-warp divide a triangle? Those whose every edge is seen under less than 45 degrees and is
// short enough for the tessellator. Whether an edge is divided follows from its ends alone, so that neighbours divide it
// alike and their parts meet without gaps. Parts that show nothing are left out; so are those around a direction that
// positions jump at.

#include "scene_geometry.glsl"
#include "warp_geometry.glsl"

const uint ALL_PIECES = 0xffffffffu;
const uint SEEN_FROM_BEHIND = 0x80000000u;  // a triangle's facing, beside its index
const float WIDEST_COSINE = 0.70710678;

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

bool isLong(vec3 a, vec3 b, vec2 pxA, vec2 pxMiddle, vec2 pxB) {
#ifdef PROJECTIVE
    return false;  // straight whatever its length
#else
    if (cosineBetween(a, b) < WIDEST_COSINE) return true;
    float askedPx = finish.y;
    if (askedPx == 0.0) return false;
    vec2 lengthsPx = edgeLengthsPx(pxA, pxMiddle, pxB);
    // Equal steps must be about equally long.
    return lengthsPx.x > MOST_DIVISIONS * askedPx || (lengthsPx.x > 4.0 * lengthsPx.y && lengthsPx.x > 2.0 * askedPx);
#endif
}

// A part of the current triangle, and where its corners and the middles of its edges land.
struct Part {
    vec3 a, b, c;
    vec2 pxA, pxB, pxC, pxAb, pxBc, pxCa;
};
uvec3 partCorners;  // of the part that is taken

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

bool isAroundTornDirection(Part p, float facing) {
    if (torn.w == 0.0) return false;
    float side = facing < 0.0 ? -1.0 : 1.0;
    return side * dot(torn.xyz, cross(p.a, p.b - p.a)) >= 0.0 && side * dot(torn.xyz, cross(p.b, p.c - p.b)) >= 0.0 &&
           side * dot(torn.xyz, cross(p.c, p.a - p.c)) >= 0.0 && dot(torn.xyz, p.a + p.b + p.c) > 0.0;
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

// How often, and from where on, the map repeats within the display along an axis; none: it does not.
ivec2 turnsWithin(float least, float most, float extentPx, float turnPx) {
    if (turnPx == 0.0) return most < 0.0 || least > extentPx ? ivec2(0) : ivec2(0, 1);
    int begin = int(ceil(-most / turnPx)), end = int(floor((extentPx - least) / turnPx)) + 1;
    begin = max(begin, -TURN_BIAS);
    return ivec2(begin, clamp(end - begin, 0, TURN_BIAS - begin));
}

void take(uint piece, uint nth);  // what the includer does with the nth part

uint takeTurns(ScreenBox box, bool isWhole, uint count, uint most) {
    ivec2 across = turnsWithin(box.least.x, box.most.x, size.x, size.z);
    ivec2 down = turnsWithin(box.least.y, box.most.y, size.y, size.w);
    // No map repeats along both.
    ivec2 turns = size.w > 0.0 ? down : across;
    int times = across.y > 0 && down.y > 0 ? turns.y : 0;
    for (int i = 0; i < times && count < most; ++i)
        take(uint(turns.x + i + TURN_BIAS) | (isWhole ? 0u : IS_DIVIDED), count++);
    return count;
}

// The middle of an edge, or NOT_BETWEEN where weights go no further.
const uint NOT_BETWEEN = 0xffffffffu;
uint middleOf(uint a, uint b) {
    uvec2 sum = uvec2((a & 0xffffu) + (b & 0xffffu), (a >> 16u) + (b >> 16u));
    if (((sum.x | sum.y) & 1u) != 0u) return NOT_BETWEEN;
    return sum.x / 2u | sum.y / 2u << 16u;
}

// Takes the parts of the triangle, `most` of them, and counts them. `begin` and `end` are those of a piece tree.
uint walk(RayTriangle t, uint begin, uint end, uint most) {
    const uint WHOLE_A = DENOMINATOR, WHOLE_B = DENOMINATOR << 16u, WHOLE_C = 0u;
    const int MOST_OPEN = 40;   // each division leaves one for later, and halves a weight
    const int MOST_STEPS = 1 << 20;
    uvec3 open[MOST_OPEN];
    open[0] = uvec3(WHOLE_A, WHOLE_B, WHOLE_C);
    int openCount = 1;
    uint count = 0u;
    for (int step = 0; step < MOST_STEPS && openCount > 0 && count < most; ++step) {
        uvec3 part = open[--openCount];
        Part p;
        p.a = pointWithin(t.a, t.b, t.c, weightsOf(part.x));
        p.b = pointWithin(t.a, t.b, t.c, weightsOf(part.y));
        p.c = pointWithin(t.a, t.b, t.c, weightsOf(part.z));
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
        if (isAroundTornDirection(p, t.facing)) box.isTorn = true;
        if (!isWide && !box.isTorn) {
            ivec2 across = turnsWithin(box.least.x, box.most.x, size.x, size.z);
            ivec2 down = turnsWithin(box.least.y, box.most.y, size.y, size.w);
            if (across.y == 0 || down.y == 0) continue;
        }
        // Around a pole only the distance from it counts.
        if (!isWide && box.isTorn && size.z > 0.0 && (box.most.y < 0.0 || box.least.y > size.y)) continue;
        if (!isWide && box.isTorn && size.w > 0.0 && (box.most.x < 0.0 || box.least.x > size.x)) continue;
#endif
        uint ab = middleOf(part.x, part.y), bc = middleOf(part.y, part.z), ca = middleOf(part.z, part.x);
        // Of the edges that have to be divided, the one that is seen widest.
        vec3 cosines = vec3(ab != NOT_BETWEEN && isLong(p.a, p.b, p.pxA, p.pxAb, p.pxB) ? cosineBetween(p.a, p.b) : 2.0,
                            bc != NOT_BETWEEN && isLong(p.b, p.c, p.pxB, p.pxBc, p.pxC) ? cosineBetween(p.b, p.c) : 2.0,
                            ca != NOT_BETWEEN && isLong(p.c, p.a, p.pxC, p.pxCa, p.pxA) ? cosineBetween(p.c, p.a) : 2.0);
        float least = min(min(cosines.x, cosines.y), cosines.z);
        if (least > 1.5 || openCount + 2 > MOST_OPEN) {
            partCorners = part;
            bool isWhole = part == uvec3(WHOLE_A, WHOLE_B, WHOLE_C);
            if (!isWide && !box.isTorn) count = takeTurns(box, isWhole, count, most);
            continue;
        }
        if (least == cosines.x) {
            open[openCount++] = uvec3(ab, part.y, part.z);
            open[openCount++] = uvec3(part.x, ab, part.z);
        } else if (least == cosines.y) {
            open[openCount++] = uvec3(part.x, bc, part.z);
            open[openCount++] = uvec3(part.x, part.y, bc);
        } else {
            open[openCount++] = uvec3(part.x, part.y, ca);
            open[openCount++] = uvec3(ca, part.y, part.z);
        }
    }
    return count;
}
