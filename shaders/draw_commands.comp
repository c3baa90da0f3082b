// One indirect draw a material range: the pairs of its triangles, in instances of PAIRS_PER_INSTANCE. Instances cost a GPU
// nothing, and llvmpipe clips them one at a time: in one long run it goes over all vertices for every few that it clips.
// MESHLETS: ranges of meshlets, whose first pairs are known; TRIANGLES: of triangles, looked up in the pairs, which are in
// their order.

#include "draw_command.glsl"

layout(local_size_x = 64) in;

struct Range {
    uint first;  // meshlet within the part, or triangle
    uint count;
};
#ifdef MESHLETS
layout(std430, binding = 4) readonly buffer GroupPairs { uint groupPairs[]; };  // the first pair of each meshlet seen
layout(std430, binding = 11) readonly buffer PlaceOf { uint placeOf[]; };       // of each meshlet among those seen
#else
layout(std430, binding = 4) readonly buffer Total { uint total; };  // pairs, those without room too
layout(std430, binding = 6) readonly buffer Pairs { uvec2 pairs[]; };
#endif
layout(std430, binding = 14) writeonly buffer Commands { DrawCommand commands[]; };
layout(std430, binding = 15) readonly buffer Ranges { Range ranges[]; };

layout(location = 5) uniform uint capacity;
layout(location = 8) uniform uint rangeCount;

#ifdef MESHLETS
uint firstPairOf(uint meshlet) { return min(groupPairs[placeOf[meshlet]], capacity); }
#else
uint firstPairOf(uint triangle) {
    uint begin = 0u, end = min(total, capacity);
    for (int halving = 0; halving < 32 && begin < end; ++halving) {
        uint middle = begin + (end - begin) / 2u;
        if ((pairs[middle].x & 0x7fffffffu) < triangle) {
            begin = middle + 1u;
        } else {
            end = middle;
        }
    }
    return begin;
}
#endif

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= rangeCount) return;
    uint first = firstPairOf(ranges[i].first);
    uint end = firstPairOf(ranges[i].first + ranges[i].count);
    uint instances = (end - first + PAIRS_PER_INSTANCE - 1u) / PAIRS_PER_INSTANCE;
    commands[i] = DrawCommand(3u * PAIRS_PER_INSTANCE, instances, 3u * first, 0u, end);
}
