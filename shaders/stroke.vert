// A triangle around the part of a point or line that lies in one piece, and all that stroke.frag needs to know which of
// its pixels the stroke covers. Each corner computes the same.

#include "draw_command.glsl"
#include "scene_geometry.glsl"

// Of a piece: three rows of H to pixels, the planes that the middle of a stroke is cut by, and those that its neighbours
// cut by too.
layout(std430, binding = 2) readonly buffer Pieces { vec4 pieces[]; };
layout(std430, binding = 3) readonly buffer Normals { uint normals[]; };
layout(std430, binding = 4) readonly buffer Uvs { vec2 uvs[]; };
layout(std430, binding = 5) readonly buffer Commands { DrawCommand commands[]; };
layout(std430, binding = 6) readonly buffer Pairs { uvec2 pairs[]; };

layout(location = 9) uniform float nearFraction;
layout(location = 13) uniform uint command;
layout(location = 14) uniform vec2 shiftPx;  // of the whole picture, for one sample of several
layout(location = 15) uniform vec2 sizePx;

layout(location = 0) flat out vec4 endsPx;
layout(location = 1) flat out vec2 inverseW;
layout(location = 2) flat out vec3 fromRay;
layout(location = 3) flat out vec3 toRay;
layout(location = 4) flat out vec3 shape;  // radius in px, whether the first and the second end are cut
layout(location = 5) flat out vec2 along;  // of the whole stroke: where the ends are
#ifdef SINGLE_COVER
layout(location = 9) flat out vec4 waysOn;  // at the two ends, along the line on the display
#endif
#ifdef TEXTURED
layout(location = 6) flat out vec4 endUvs;  // of the whole stroke
#endif
#ifdef LIT
layout(location = 7) flat out vec3 fromNormal;
layout(location = 8) flat out vec3 toNormal;
#endif

#include "packed_normal.glsl"

// A part of the way from one end of a stroke to the other.
struct Part {
    float from, to;
    bool fromIsCut, toIsCut;
};

// Cuts a part by a plane that the two ends are a and b above. What lies in the plane is inside where `keepsZero`. False
// where nothing is left.
bool cutBy(float a, float b, bool keepsZero, inout Part part) {
    bool aIsIn = a > 0.0 || (a == 0.0 && keepsZero), bIsIn = b > 0.0 || (b == 0.0 && keepsZero);
    if (!aIsIn && !bIsIn) return false;
    if (!aIsIn) {
        part.from = max(part.from, a / (a - b));
        part.fromIsCut = true;
    }
    if (!bIsIn) {
        part.to = min(part.to, a / (a - b));
        part.toIsCut = true;
    }
    return part.from <= part.to;
}

bool cutToPiece(uint firstPlane, vec3 a, vec3 b, inout Part part) {
    for (uint i = 0u; i < MOST_EDGES; ++i) {
        vec4 plane = pieces[firstPlane + i];
        if (!cutBy(dot(plane.xyz, a), dot(plane.xyz, b), plane.w >= 0.0, part)) return false;
    }
    return true;
}

// The corners of a triangle around the box of half size `halfSize`.
vec2 corner(int index, vec2 halfSize) {
    return halfSize * vec2(index == 1 ? 3.0 : -1.0, index == 2 ? 3.0 : -1.0);
}

void main() {
    gl_Position = vec4(0.0, 0.0, 0.5, 1.0);
    endsPx = vec4(0.0);
    inverseW = vec2(0.0);
    fromRay = toRay = vec3(0.0);
    shape = vec3(0.0);
    along = vec2(0.0);
#ifdef SINGLE_COVER
    waysOn = vec4(0.0);
#endif
#ifdef TEXTURED
    endUvs = vec4(0.0);
#endif
#ifdef LIT
    fromNormal = toNormal = vec3(0.0);
#endif
    uint index = uint(gl_VertexID) / 3u + uint(gl_InstanceID) * PAIRS_PER_INSTANCE;
    // What the last instance has too much, and what is cut away, becomes a point, which is not drawn.
    if (index >= commands[command].endPair || pairs[index].y == NO_PIECE) return;
    uvec2 pair = pairs[index];
    uint triangle = pair.x & 0x7fffffffu;
    uint first = corners[3u * triangle], second = corners[3u * triangle + 1u];
    vec3 a = rayToVertex(first), b = rayToVertex(second);
    uint row = pair.y * (3u + 2u * MOST_EDGES);
#ifdef SINGLE_COVER
    uint firstPlane = row + 3u + MOST_EDGES;
#else
    uint firstPlane = row + 3u;
#endif
    Part part = Part(0.0, 1.0, false, false);
    if (!cutToPiece(firstPlane, a, b, part)) return;
    float nearAtA = dot(pieces[row + 2u].xyz, a) - nearFraction, nearAtB = dot(pieces[row + 2u].xyz, b) - nearFraction;
    if (!cutBy(nearAtA, nearAtB, true, part)) return;

    fromRay = part.fromIsCut ? mix(a, b, part.from) : a;
    toRay = part.toIsCut ? mix(a, b, part.to) : b;
    vec2 w = vec2(dot(pieces[row + 2u].xyz, fromRay), dot(pieces[row + 2u].xyz, toRay));
    inverseW = 1.0 / w;
    endsPx = vec4(dot(pieces[row].xyz, fromRay), dot(pieces[row + 1u].xyz, fromRay), dot(pieces[row].xyz, toRay),
                  dot(pieces[row + 1u].xyz, toRay)) * inverseW.xxyy;
    shape = vec3(first == second ? POINT_RADIUS_PX : LINE_RADIUS_PX, part.fromIsCut, part.toIsCut);
    along = vec2(part.from, part.to);
#ifdef SINGLE_COVER
    // The derivative of H r / w: of a part of hardly any length, the ends say nothing about its direction.
    vec3 step = vec3(dot(pieces[row].xyz, b - a), dot(pieces[row + 1u].xyz, b - a), dot(pieces[row + 2u].xyz, b - a));
    waysOn = step.xyxy - step.z * endsPx;
#endif
#ifdef TEXTURED
    endUvs = vec4(uvs[first], uvs[second]);
#endif
#ifdef LIT
    fromNormal = unpackNormal(normals[first]);
    toNormal = unpackNormal(normals[second]);
#endif

    vec2 way = endsPx.zw - endsPx.xy;
    float lengthPx = length(way);
    vec2 ahead = lengthPx > 0.0 ? way / lengthPx : vec2(1.0, 0.0);
    float reachPx = shape.x + 1.0;  // half a pixel for its samples, and some for the rounding
    vec2 at = corner(gl_VertexID % 3, vec2(0.5 * lengthPx + reachPx, reachPx));
    vec2 px = 0.5 * (endsPx.xy + endsPx.zw) + at.x * ahead + at.y * vec2(-ahead.y, ahead.x) + shiftPx;
    gl_Position.xy = 2.0 * px / sizePx - 1.0;
}
