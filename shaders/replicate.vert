// How often is a triangle replicated? The tessellation engine's patches are triangles, by number. Lorenz and Doellner (2009),
// section 2.2, count in the next stage, of which a GPU runs one invocation a patch: here neighbours are counted together.

#include "piece_coverage.glsl"
#include "tessellated.glsl"

layout(location = 0) flat out uvec2 triangleAndCount;  // triangle and facing
layout(location = 1) flat out uvec4 kept[KEPT_VECTORS];

uvec4 found[KEPT_VECTORS];

void take(uint piece, uint nth) {
    if (nth < KEPT) found[nth / 4u][nth % 4u] = piece;
}

void main() {
    uint triangle = uint(gl_VertexID);
    RayTriangle t = rayTriangleAt(triangle);
    bool behind = t.facing > 0.0;
    uint count = 0u;
#ifdef SINGLE_SIDED
    if (!behind)
#endif
        count = walk(t, 0u, nodeCount, ALL_PIECES);
    triangleAndCount = uvec2(triangle | (behind ? SEEN_FROM_BEHIND : 0u), count);
    for (uint i = 0u; i < KEPT_VECTORS; ++i) kept[i] = found[i];
}
