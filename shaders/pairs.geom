// Turns replication numbers into (triangle, piece) pairs, in order.

#include "piece_coverage.glsl"
#include "replications.glsl"

layout(points) in;
layout(points, max_vertices = MOST_PARTS) out;

layout(location = 0) flat in uvec3 triangleFirstCount[];
layout(location = 1) flat in uvec3 kept[];

layout(xfb_buffer = 0, xfb_stride = 8) out;
layout(location = 0, xfb_offset = 0) flat out uvec2 pair;

void take(uint piece, uint nth) {
    if (nth < triangleFirstCount[0].y) return;
    pair = uvec2(triangleFirstCount[0].x, piece);
    EmitVertex();
}

void main() {
    uint end = triangleFirstCount[0].y + triangleFirstCount[0].z;
    if (end > KEPT) {
        walk(rayTriangleAt(triangleFirstCount[0].x & ~SEEN_FROM_BEHIND), 0u, nodeCount, end);
        return;
    }
    for (uint i = 0u; i < KEPT; ++i) {
        if (i < end) take(kept[0][i], i);
    }
}
