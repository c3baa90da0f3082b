// A corner of a part of a triangle, for vertex-warp. It goes where the display shows it, with straight lines in between
// (Oros, A conceptual and practical look into spherical curvilinear projection; Lorenz and Doellner, 2009, section 1.1, of
// camera textures). TESSELLATED: to where the tessellator has it.

#include "draw_command.glsl"
#include "scene_geometry.glsl"
#include "warp_geometry.glsl"
#include "packed_normal.glsl"

layout(std430, binding = 3) readonly buffer Normals { uint normals[]; };
layout(std430, binding = 4) readonly buffer Uvs { vec2 uvs[]; };
layout(std430, binding = 5) readonly buffer Commands { DrawCommand commands[]; };
layout(std430, binding = 6) readonly buffer Pairs { uvec2 pairs[]; };  // triangle and facing, turn of the map and whether divided
layout(std430, binding = 8) readonly buffer Parts { uvec2 parts[]; };      // three corners of each that is divided
layout(location = 13) uniform uint command;

layout(location = 0) out vec3 ray;
#ifdef LIT
layout(location = 1) out vec3 normal;
#endif
#ifdef TEXTURED
layout(location = 2) out vec2 uv;
#endif
#ifdef EDGES
#include "edges.glsl"
#endif
#ifdef TESSELLATED
layout(location = 6) out vec3 referenceAndLevel;  // where the part lies, px; how often the edge opposite is divided, 0: no part
#else
#ifdef OWNED
layout(location = 3) flat out int ownPiece;
#endif
#include "warp_landing.glsl"
#endif

const uint SEEN_FROM_BEHIND = 0x80000000u;

uvec3 vertexIndices;
vec3 triangleRays[3];

vec3 rayAt(vec3 weights) { return pointWithin(triangleRays[0], triangleRays[1], triangleRays[2], weights); }

// What a corner is made of: of each vertex of the triangle how much.
vec3 sharesAt(vec3 at) {
    if (max(max(at.x, at.y), at.z) == 1.0) return at;
    return sharesWithin(triangleRays[0], triangleRays[1], triangleRays[2], at);
}

void main() {
    uint index = uint(gl_VertexID) / 3u + uint(gl_InstanceID) * PAIRS_PER_INSTANCE, corner = uint(gl_VertexID) % 3u;
    uvec2 pair = index < commands[command].endPair ? pairs[index] : uvec2(0u, NO_PIECE);
    bool none = pair.y == NO_PIECE;
    if (none) pair = uvec2(0u);
    uint triangle = pair.x & ~SEEN_FROM_BEHIND;
    vertexIndices = uvec3(corners[3u * triangle], corners[3u * triangle + 1u], corners[3u * triangle + 2u]);
    for (int i = 0; i < 3; ++i) triangleRays[i] = rayToVertex(vertexIndices[i]);
    mat3 at = mat3(1.0);
    if ((pair.y & IS_DIVIDED) != 0u)
        at = mat3(weightsOf(parts[3u * index]), weightsOf(parts[3u * index + 1u]), weightsOf(parts[3u * index + 2u]));

    ray = rayAt(at[corner]);
    vec3 shares = sharesAt(at[corner]);
#ifdef LIT
    normal = shares.x * unpackNormal(normals[vertexIndices.x]) + shares.y * unpackNormal(normals[vertexIndices.y]) +
             shares.z * unpackNormal(normals[vertexIndices.z]);
    if ((pair.x & SEEN_FROM_BEHIND) != 0u) normal = -normal;
#endif
#ifdef TEXTURED
    uv = shares.x * uvs[vertexIndices.x] + shares.y * uvs[vertexIndices.y] + shares.z * uvs[vertexIndices.z];
#endif
#ifdef EDGES
    sendEdges(triangle, corner);
    weights = shares;
#endif
    vec2 reference = vec2(0.0);
    if (size.z > 0.0 || size.w > 0.0)
        reference = pixelsOf(rayAt(at[0])) + float(int(pair.y & 15u) - TURN_BIAS) * size.zw;
#ifdef TESSELLATED
    float level = none ? 0.0 : 1.0;
#ifndef PROJECTIVE
    if (!none) {
        vec3 from = rayAt(at[(corner + 1u) % 3u]), to = rayAt(at[(corner + 2u) % 3u]);
        float lengthPx = edgeLengthsPx(pixelsOf(from), pixelsOf(pointBetween(from, to, 1.0, 1.0)), pixelsOf(to)).x;
        level = clamp(ceil(lengthPx / finish.y), 1.0, MOST_DIVISIONS);
    }
#endif
    referenceAndLevel = vec3(reference, level);
#else
#ifdef OWNED
    ownPiece = 0;
#endif
    landNear(ray, reference);
    if (none) gl_Position = vec4(0.0, 0.0, 0.5, 1.0);  // a point, which is not drawn
#endif
}
