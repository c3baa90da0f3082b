// Has the tessellator make a point of each replication. Isolines drawn as points give any number up to
// lines * (segments + 1), none of them twice.

#include "tessellated.glsl"

layout(vertices = 1) out;

layout(location = 0) flat in uvec2 triangleAndCount[];
layout(location = 1) flat in uvec4 kept[][KEPT_VECTORS];

layout(location = 0) patch out uvec4 replicas;  // triangle and facing, how many, points a line, replications a point
layout(location = 1) patch out uvec4 patchKept[KEPT_VECTORS];

void main() {
    uint count = triangleAndCount[0].y;
    uint aPoint = (count + MOST_POINTS - 1u) / MOST_POINTS;
    uint points = count == 0u ? 0u : (count + aPoint - 1u) / aPoint;
    uint lines = (points + MOST_POINTS_A_LINE - 1u) / MOST_POINTS_A_LINE;
    // A line has two ends.
    uint pointsALine = lines == 0u ? 2u : max(2u, (points + lines - 1u) / lines);
    gl_TessLevelOuter[0] = float(lines);  // none: the patch is dropped
    gl_TessLevelOuter[1] = float(pointsALine - 1u);
    replicas = uvec4(triangleAndCount[0].x, count, pointsALine, aPoint);
    for (uint i = 0u; i < KEPT_VECTORS; ++i) patchKept[i] = kept[0][i];
}
