// A triangle's corner on the screen of one piece: H r, with w = 1 on the facet. PAIRS pulls the corner of a
// (triangle, piece) pair; without it one piece serves the whole display and corners come as plain vertices, but for EDGES,
// which has to know what triangle they are of.

#include "draw_command.glsl"
#include "scene_geometry.glsl"

layout(std430, binding = 2) readonly buffer Pieces { vec4 pieces[]; };  // three rows of H to clip space, then planes

layout(location = 14) uniform vec2 shift;  // of the whole picture, clip space, for one sample of several

layout(location = 9) uniform float nearFraction;  // depth = nearFraction / w, reversed

#if defined(PAIRS) || defined(EDGES)
#define PULLED
layout(std430, binding = 3) readonly buffer Normals { uint normals[]; };
layout(std430, binding = 4) readonly buffer Uvs { vec2 uvs[]; };
#else
layout(location = 0) in vec3 vertexPosition;
layout(location = 1) in vec4 vertexNormal;
layout(location = 2) in vec2 vertexUv;
#endif
#ifdef PAIRS
layout(std430, binding = 5) readonly buffer Commands { DrawCommand commands[]; };
layout(std430, binding = 6) readonly buffer Pairs { uvec2 pairs[]; };
layout(location = 13) uniform uint command;
#endif
#ifdef EDGES
#include "edges.glsl"
#endif

#ifdef LOOP
layout(location = 18) uniform uint loopPiece;
#endif

layout(location = 0) out vec3 ray;
#ifdef LIT
layout(location = 1) out vec3 normal;
#endif
#ifdef TEXTURED
layout(location = 2) out vec2 uv;
#endif
#ifdef OWNED
layout(location = 3) flat out int ownPiece;
#endif

#if CLIP_PLANES > 0
out float gl_ClipDistance[CLIP_PLANES];
#endif

// Normals are packed as signed 10-bit integers, x lowest.
vec3 unpackNormal(uint bits) {
    ivec3 parts = ivec3(int(bits << 22u) >> 22, int(bits << 12u) >> 22, int(bits << 2u) >> 22);
    return vec3(parts) / 511.0;
}

void main() {
#ifdef PAIRS
    uint index = uint(gl_VertexID) / 3u + uint(gl_InstanceID) * PAIRS_PER_INSTANCE;
    // What the last instance has too much becomes a point, which is not drawn.
    bool none = index >= commands[command].endPair;
    uvec2 pair = none ? uvec2(0u) : pairs[index];
    uint triangle = pair.x & 0x7fffffffu, piece = pair.y;
    float facing = (pair.x & 0x80000000u) != 0u ? -1.0 : 1.0;
#else
    uint triangle = uint(gl_VertexID) / 3u;
#ifdef LOOP
    uint piece = loopPiece;
#else
    uint piece = 0u;
#endif
    float facing = 1.0;  // scene.frag turns the normals
#endif
#ifdef PULLED
    uint corner = uint(gl_VertexID) % 3u;
    uint vertex = corners[3u * triangle + corner];
    ray = rayToVertex(vertex);
#ifdef LIT
    normal = unpackNormal(normals[vertex]) * facing;
#endif
#ifdef TEXTURED
    uv = uvs[vertex];
#endif
#ifdef EDGES
    sendEdges(triangle, corner);
#endif
#else
    ray = rayTo(vertexPosition);
#ifdef LIT
    normal = vertexNormal.xyz;
#endif
#ifdef TEXTURED
    uv = vertexUv;
#endif
#endif
#ifdef OWNED
    ownPiece = int(piece);
#endif
    uint row = piece * uint(3 + CLIP_PLANES);
    gl_Position = vec4(dot(pieces[row].xyz, ray), dot(pieces[row + 1u].xyz, ray), nearFraction,
                       dot(pieces[row + 2u].xyz, ray));
    gl_Position.xy += shift * gl_Position.w;
#if CLIP_PLANES > 0
    for (uint i = 0u; i < uint(CLIP_PLANES); ++i) gl_ClipDistance[i] = dot(pieces[row + 3u + i].xyz, ray);
#endif
#ifdef PAIRS
    if (none) {
        gl_Position = vec4(0.0, 0.0, 0.5, 1.0);
#if CLIP_PLANES > 0
        for (uint i = 0u; i < uint(CLIP_PLANES); ++i) gl_ClipDistance[i] = 1.0;
#endif
    }
#endif
}
