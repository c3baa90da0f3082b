// How often is a triangle replicated? Lorenz and Doellner (2009), section 2.2: the tessellator makes as many of it. Isolines
// drawn as points give any number up to lines * (segments + 1), none of them twice.

#include "piece_coverage.glsl"
#include "tessellated.glsl"

layout(vertices = 1) out;

layout(location = 0) flat in uint triangle[];
layout(location = 0) patch out uvec4 replicas;  // triangle and facing, how many, points a line, replications a point
layout(location = 1) patch out uvec4 kept[KEPT_VECTORS];

uvec4 found[KEPT_VECTORS];

void take(uint piece, uint nth) {
    if (nth < KEPT) found[nth / 4u][nth % 4u] = piece;
}

void main() {
    RayTriangle t = rayTriangleAt(triangle[0]);
    bool behind = t.facing > 0.0;
#ifdef SINGLE_SIDED
    uint count = 0u;
    if (!behind) count = walk(t, 0u, nodeCount, ALL_PIECES);
#else
    uint count = walk(t, 0u, nodeCount, ALL_PIECES);
#endif
    uint aPoint = (count + MOST_POINTS - 1u) / MOST_POINTS;
    uint points = count == 0u ? 0u : (count + aPoint - 1u) / aPoint;
    uint lines = (points + MOST_POINTS_A_LINE - 1u) / MOST_POINTS_A_LINE;
    // A line has two ends.
    uint pointsALine = lines == 0u ? 2u : max(2u, (points + lines - 1u) / lines);
    gl_TessLevelOuter[0] = float(lines);  // none: the patch is dropped
    gl_TessLevelOuter[1] = float(pointsALine - 1u);
    replicas = uvec4(triangle[0] | (behind ? SEEN_FROM_BEHIND : 0u), count, pointsALine, aPoint);
    for (uint i = 0u; i < KEPT_VECTORS; ++i) kept[i] = found[i];
}
