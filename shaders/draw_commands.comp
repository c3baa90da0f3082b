// One indirect draw a material range: the pairs of its triangles.

layout(local_size_x = 64) in;

struct Range {
    uint firstTriangle;  // within the part
    uint triangleCount;
};
struct DrawCommand {  // as glDrawArraysIndirect reads it
    uint count;
    uint instanceCount;
    uint first;
    uint baseInstance;
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
    commands[i] = DrawCommand(3u * (end - first), 1u, 3u * first, 0u);
}
