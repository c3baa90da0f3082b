// Splits a triangle's replications into parts of at most `partSize`, so that no pass has to bring forth more than MOST_PARTS
// of one thing, and a triangle may yet have any number of them.

layout(points) in;
layout(points, max_vertices = MOST_PARTS) out;

layout(location = 0) flat in uvec3 triangleFirstCount[];
layout(location = 1) flat in uvec3 kept[];

layout(xfb_buffer = 0, xfb_stride = 24) out;
layout(location = 0, xfb_offset = 0) flat out uvec3 partTriangleFirstCount;
layout(location = 1, xfb_offset = 12) flat out uvec3 partKept;

layout(location = 21) uniform uint partSize;

void main() {
    uvec3 whole = triangleFirstCount[0];
    for (uint i = 0u; i < MOST_PARTS; ++i) {
        uint before = i * partSize;
        if (before >= whole.z) break;
        partTriangleFirstCount = uvec3(whole.x, whole.y + before, min(partSize, whole.z - before));
        partKept = kept[0];
        EmitVertex();
    }
}
