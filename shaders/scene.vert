// A triangle's corner on the screen of one piece. PAIRS pulls the corner of a (triangle, piece) pair; without it one piece
// serves the whole display, or LOOP draws one after the other, and corners come as plain vertices, but for EDGES, which has
// to know what triangle they are of.

#include "draw_command.glsl"
#include "scene_geometry.glsl"

layout(std430, binding = 2) readonly buffer PieceRows { vec4 pieceRows[]; };

#if defined(PAIRS) || defined(EDGES)
#define PULLED
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
#ifdef LOOP
layout(location = 18) uniform uint loopPiece;
#else
const uint loopPiece = 0u;
#endif

#include "scene_corner.glsl"

void main() {
#ifdef PAIRS
    uint index = uint(gl_VertexID) / 3u + uint(gl_InstanceID) * PAIRS_PER_INSTANCE;
    // What the last instance has too much, and a pair without a piece, becomes a point, which is not drawn.
    uvec2 pair = index < commands[command].endPair ? pairs[index] : uvec2(0u, NO_PIECE);
    bool none = pair.y == NO_PIECE;
    if (none) pair = uvec2(0u);
    sendCorner(pair.x, uint(gl_VertexID) % 3u, pair.y);
    if (none) {
        gl_Position = vec4(0.0, 0.0, 0.5, 1.0);
#if CLIP_PLANES > 0
        for (uint i = 0u; i < uint(CLIP_PLANES); ++i) gl_ClipDistance[i] = 1.0;
#endif
    }
#elif defined(PULLED)
    sendCorner(uint(gl_VertexID) / 3u, uint(gl_VertexID) % 3u, loopPiece);  // scene.frag turns the normals
#else
    ray = rayTo(vertexPosition);
#ifdef LIT
    normal = vertexNormal.xyz;
#endif
#ifdef TEXTURED
    uv = vertexUv;
#endif
    land(loopPiece);
#endif
}
