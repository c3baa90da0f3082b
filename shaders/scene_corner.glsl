// A triangle's corner as scene.frag reads it, and where it lands on the screen of one piece: H r, with w = 1 on the facet.
// The includer declares pieceRows: three rows of H to clip space, then planes, a piece.

layout(location = 14) uniform vec2 shift;         // of the whole picture, clip space, for one sample of several
layout(location = 9) uniform float nearFraction;  // depth = nearFraction / w, reversed

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

// Puts `ray` on the screen of a piece.
void land(uint piece) {
    uint row = piece * uint(3 + CLIP_PLANES);
    gl_Position = vec4(dot(pieceRows[row].xyz, ray), dot(pieceRows[row + 1u].xyz, ray), nearFraction,
                       dot(pieceRows[row + 2u].xyz, ray));
    gl_Position.xy += shift * gl_Position.w;
#if CLIP_PLANES > 0
    for (uint i = 0u; i < uint(CLIP_PLANES); ++i) gl_ClipDistance[i] = dot(pieceRows[row + 3u + i].xyz, ray);
#endif
#ifdef OWNED
    ownPiece = int(piece);
#endif
}

#ifdef PULLED
#ifdef EDGES
#include "edges.glsl"
#endif
layout(std430, binding = 3) readonly buffer Normals { uint normals[]; };
layout(std430, binding = 4) readonly buffer Uvs { vec2 uvs[]; };

#include "packed_normal.glsl"

// The highest bit beside the triangle tells that it is seen from behind.
void sendCorner(uint triangleAndFacing, uint corner, uint piece) {
    uint vertex = corners[3u * (triangleAndFacing & 0x7fffffffu) + corner];
    ray = rayToVertex(vertex);
#ifdef LIT
    normal = unpackNormal(normals[vertex]) * ((triangleAndFacing & 0x80000000u) != 0u ? -1.0 : 1.0);
#endif
#ifdef TEXTURED
    uv = uvs[vertex];
#endif
#ifdef EDGES
    sendEdges(triangleAndFacing & 0x7fffffffu, corner);
#endif
    land(piece);
}
#endif
