// Which of its triangle's replications is a point?

#include "tessellated.glsl"

layout(isolines, equal_spacing, point_mode) in;

layout(location = 0) patch in uvec4 replications;
layout(location = 1) patch in uvec4 patchKept[KEPT_VECTORS];

layout(location = 0) flat out uvec4 replication;  // triangle and facing, number, the piece, whether that is known
layout(location = 1) flat out uint isOne;         // not a point too many

void main() {
    uint pointsALine = replications.w;
    uint onLine = uint(gl_TessCoord.x * float(pointsALine - 1u) + 0.5);
    uint line = uint(gl_TessCoord.y * gl_TessLevelOuter[0] + 0.5);
    uint index = line * pointsALine + onLine, number = replications.y + index;
    isOne = index < replications.z ? 1u : 0u;
    bool isKept = number < KEPT;
    uint place = isKept ? number : 0u;
    replication = uvec4(replications.x, number, patchKept[place / 4u][place % 4u], isKept ? 1u : 0u);
}
