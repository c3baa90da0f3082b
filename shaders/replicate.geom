// Draws the replications that a point stands for, each in its piece.

#define PULLED
#include "piece_coverage.glsl"
#include "scene_corner.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = 3 * REPLICATIONS_A_POINT) out;

layout(location = 0) flat in uvec4 replications[];

uint found[REPLICATIONS_A_POINT];

void take(uint piece, uint nth) {
    uint first = replications[0].y;
    if (nth >= first) found[nth - first] = piece;
}

void main() {
    uint triangleAndFacing = replications[0].x, first = replications[0].y, count = replications[0].z;
    found[0] = replications[0].w;
    if (count > 0u && found[0] == NO_PIECE) {
        uint end = walk(rayTriangleAt(triangleAndFacing & ~SEEN_FROM_BEHIND), 0u, nodeCount, first + count);
        count = max(end, first) - first;
    }
    for (uint i = 0u; i < REPLICATIONS_A_POINT; ++i) {
        if (i >= count) break;
        for (uint corner = 0u; corner < 3u; ++corner) {
            sendCorner(triangleAndFacing, corner, found[i]);
            EmitVertex();
        }
        EndPrimitive();
    }
}
