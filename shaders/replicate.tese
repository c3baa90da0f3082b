// Which of its triangle's replications does a point stand for?

#include "tessellated.glsl"

layout(isolines, equal_spacing, point_mode) in;

layout(location = 0) patch in uvec4 replicas;
layout(location = 1) patch in uvec4 patchKept[KEPT_VECTORS];

layout(location = 0) flat out uvec4 replications;  // triangle and facing, first number, how many, the piece where it is known
const uint NO_PIECE = 0xffffffffu;

void main() {
    uint total = replicas.y, pointsALine = replicas.z, aPoint = replicas.w;
    uint onLine = uint(gl_TessCoord.x * float(pointsALine - 1u) + 0.5);
    uint line = uint(gl_TessCoord.y * gl_TessLevelOuter[0] + 0.5);
    uint first = min((line * pointsALine + onLine) * aPoint, total);
    bool isKept = aPoint == 1u && first < KEPT;
    replications = uvec4(replicas.x, first, min(aPoint, total - first), isKept ? patchKept[first / 4u][first % 4u] : NO_PIECE);
}
