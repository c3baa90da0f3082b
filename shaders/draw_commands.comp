// One indirect draw a material range: the pairs of its triangles, in instances of PAIRS_PER_INSTANCE. Instances cost a GPU
// nothing, and llvmpipe clips them one at a time: in one long run it goes over all vertices for every few that it clips.

#include "draw_command.glsl"

layout(local_size_x = 64) in;

struct Range {
    uint firstTriangle;  // within the part
    uint triangleCount;
};
layout(std430, binding = 2) readonly buffer Ranges { Range ranges[]; };
layout(std430, binding = 3) writeonly buffer Commands { DrawCommand commands[]; };
layout(std430, binding = 5) readonly buffer FirstPair { uint firstPair[]; };

layout(location = 5) uniform uint capacity;
layout(location = 8) uniform uint rangeCount;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= rangeCount) return;
    uint first = min(firstPair[ranges[i].firstTriangle], capacity);
    uint end = min(firstPair[ranges[i].firstTriangle + ranges[i].triangleCount], capacity);
    uint instances = (end - first + PAIRS_PER_INSTANCE - 1u) / PAIRS_PER_INSTANCE;
    commands[i] = DrawCommand(3u * PAIRS_PER_INSTANCE, instances, 3u * first, 0u, end);
}
