// How often is a triangle replicated? The tessellation engine's patches are triangles, by number. Lorenz and Doellner (2009),
// section 2.2, count in the next stage, where llvmpipe takes one patch at a time and needs 8 to 60 times as long. Where a
// triangle may touch more pieces than the tessellator can make points, several patches in a row share it.

#include "piece_coverage.glsl"
#include "tessellated.glsl"

layout(location = 20) uniform uint patchesATriangle;

layout(location = 0) flat out uvec3 triangleFirstCount;  // triangle and facing; numbered as walk() takes its pieces
layout(location = 1) flat out uvec4 kept[KEPT_VECTORS];  // the triangle's first pieces

uvec4 found[KEPT_VECTORS];

void take(uint piece, uint nth) {
    if (nth < KEPT) found[nth / 4u][nth % 4u] = piece;
}

void main() {
    uint triangle = uint(gl_VertexID) / patchesATriangle;
    RayTriangle t = rayTriangleAt(triangle);
    bool behind = t.facing > 0.0;
    uint count = 0u;
#ifdef SINGLE_SIDED
    if (!behind)
#endif
        count = walk(t, 0u, nodeCount, ALL_PIECES);
    uint first = min(uint(gl_VertexID) % patchesATriangle * MOST_POINTS, count);
    triangleFirstCount = uvec3(triangle | (behind ? SEEN_FROM_BEHIND : 0u), first, min(count - first, MOST_POINTS));
    for (uint i = 0u; i < KEPT_VECTORS; ++i) kept[i] = found[i];
}
