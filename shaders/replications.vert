// What split.geom and pairs.geom start from. COUNT: a triangle, with the pieces that it touches counted (Lorenz and Doellner,
// 2009, section 2.1, pass 1); without it what the pass before has left.

#ifdef COUNT
#include "piece_coverage.glsl"
#endif
#include "replications.glsl"

layout(location = 0) flat out uvec3 triangleFirstCount;  // triangle and facing; numbered as walk() takes its pieces
layout(location = 1) flat out uvec3 kept;                // the triangle's first pieces, whatever part of them this is

#ifdef COUNT
layout(location = 20) uniform bool isSingleSided;

uvec3 found = uvec3(0u);

void take(uint piece, uint nth) {
    if (nth < KEPT) found[nth] = piece;
}

void main() {
    uint triangle = uint(gl_VertexID);
    RayTriangle t = rayTriangleAt(triangle);
    bool behind = t.facing > 0.0;
    uint count = 0u;
    if (!(behind && isSingleSided)) count = walk(t, 0u, nodeCount, ALL_PIECES);
    triangleFirstCount = uvec3(triangle | (behind ? SEEN_FROM_BEHIND : 0u), 0u, count);
    kept = found;
}
#else
layout(location = 0) in uvec3 recordTriangleFirstCount;
layout(location = 1) in uvec3 recordKept;

void main() {
    triangleFirstCount = recordTriangleFirstCount;
    kept = recordKept;
}
#endif
