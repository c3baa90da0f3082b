// Has the tessellator make a point of each replication.

#include "tessellated.glsl"

layout(vertices = 1) out;

layout(location = 0) flat in uvec3 triangleFirstCount[];
layout(location = 1) flat in uvec4 kept[][KEPT_VECTORS];

layout(location = 0) patch out uvec4 replications;  // triangle and facing, the first's number, how many, points a line
layout(location = 1) patch out uvec4 patchKept[KEPT_VECTORS];

void main() {
    uint count = triangleFirstCount[0].z;
    uint lines = (count + MOST_POINTS_A_LINE - 1u) / MOST_POINTS_A_LINE;
    // A line has two ends.
    uint pointsALine = lines == 0u ? 2u : max(2u, (count + lines - 1u) / lines);
    gl_TessLevelOuter[0] = float(lines);  // none: the patch is dropped
    gl_TessLevelOuter[1] = float(pointsALine - 1u);
    replications = uvec4(triangleFirstCount[0], pointsALine);
    for (uint i = 0u; i < KEPT_VECTORS; ++i) patchKept[i] = kept[0][i];
}
