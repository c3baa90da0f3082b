// One indirect draw a material range: the pairs of its triangles, in instances of PAIRS_PER_INSTANCE. Instances cost a GPU
// nothing, and llvmpipe clips them one at a time: in one long run it goes over all vertices for every few that it clips.

#include "draw_command.glsl"

layout(local_size_x = 64) in;

struct Range {
    uint firstMeshlet;  // within the part
    uint meshletCount;
};
layout(std430, binding = 4) readonly buffer GroupPairs { uint groupPairs[]; };  // the first pair of each meshlet seen
layout(std430, binding = 11) readonly buffer PlaceOf { uint placeOf[]; };       // of each meshlet among those seen
layout(std430, binding = 14) writeonly buffer Commands { DrawCommand commands[]; };
layout(std430, binding = 15) readonly buffer Ranges { Range ranges[]; };

layout(location = 5) uniform uint capacity;
layout(location = 8) uniform uint rangeCount;

uint firstPairOf(uint meshlet) { return min(groupPairs[placeOf[meshlet]], capacity); }

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= rangeCount) return;
    uint first = firstPairOf(ranges[i].firstMeshlet);
    uint end = firstPairOf(ranges[i].firstMeshlet + ranges[i].meshletCount);
    uint instances = (end - first + PAIRS_PER_INSTANCE - 1u) / PAIRS_PER_INSTANCE;
    commands[i] = DrawCommand(3u * PAIRS_PER_INSTANCE, instances, 3u * first, 0u, end);
}
