// Draws a replication in its piece.

#define PULLED
#include "piece_coverage.glsl"
#include "scene_corner.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = 3) out;

layout(location = 0) flat in uvec4 replication[];
layout(location = 1) flat in uint isOne[];

uint found;

void take(uint piece, uint nth) { found = piece; }

void main() {
    if (isOne[0] == 0u) return;
    uint triangleAndFacing = replication[0].x, number = replication[0].y;
    found = replication[0].z;
    if (replication[0].w == 0u)
        walk(rayTriangleAt(triangleAndFacing & ~SEEN_FROM_BEHIND), 0u, nodeCount, number + 1u);
    for (uint corner = 0u; corner < 3u; ++corner) {
        sendCorner(triangleAndFacing, corner, found);
        EmitVertex();
    }
    EndPrimitive();
}
