// Which pieces does each triangle touch? Run twice a frame: COUNT, and after scan.comp EMIT, which writes the pairs in
// scene order so that the same request draws the same picture. Lorenz and Doellner (2009), section 2.1, count in pass 1
// and replicate in pass 2; here both walk the tree over the pieces instead of a fixed grid.

#include "scene_geometry.glsl"

layout(local_size_x = GROUP_SIZE) in;

struct ConeNode {
    vec4 planes[4];  // xyz: through the eye; zero where the node is unbounded
    uvec4 link;      // x: the node after this subtree, y: the piece of a leaf or NO_PIECE
};
const uint NO_PIECE = 0xffffffffu;
const uint SEEN_FROM_BEHIND = 0x80000000u;

layout(std430, binding = 2) readonly buffer Nodes { ConeNode nodes[]; };
layout(std430, binding = 3) readonly buffer SingleSided { uint singleSided[]; };  // one bit a triangle
layout(std430, binding = 4) buffer GroupPairs { uint groupPairs[]; };   // COUNT: pairs of a group; EMIT: its first
layout(std430, binding = 5) buffer FirstPair { uint firstPair[]; };     // of each triangle, and of the one after the last
layout(std430, binding = 6) writeonly buffer Pairs { uvec2 pairs[]; };  // triangle and facing, piece

layout(location = 2) uniform uint firstTriangle;
layout(location = 3) uniform uint triangleCount;
layout(location = 4) uniform uint nodeCount;
layout(location = 5) uniform uint capacity;  // of `pairs`; what lies beyond is drawn in another part

shared uint sums[GROUP_SIZE];

bool outside(ConeNode node, vec3 a, vec3 b, vec3 c) {
    for (int i = 0; i < 4; ++i) {
        vec3 plane = node.planes[i].xyz;
        if (max(max(dot(plane, a), dot(plane, b)), dot(plane, c)) < 0.0) return true;
    }
    return false;
}

// Exclusive sum of `value` over the group.
uint groupPrefix(uint value) {
    uint self = gl_LocalInvocationIndex;
    sums[self] = value;
    barrier();
    for (uint reach = 1u; reach < GROUP_SIZE; reach *= 2u) {
        uint before = self >= reach ? sums[self - reach] : 0u;
        barrier();
        sums[self] += before;
        barrier();
    }
    return sums[self] - value;
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    uint triangle = firstTriangle + index;
    bool inUse = index < triangleCount;

    vec3 a = vec3(0.0), b = vec3(0.0), c = vec3(0.0);
    bool behind = false;
    if (inUse) {
        a = rayToVertex(corners[3u * triangle]);
        b = rayToVertex(corners[3u * triangle + 1u]);
        c = rayToVertex(corners[3u * triangle + 2u]);
        // Facing is a property of the triangle and the eye, not of any piece's screen.
        behind = dot(a, cross(b, c)) > 0.0;
        if (behind && (singleSided[triangle / 32u] >> (triangle % 32u) & 1u) != 0u) inUse = false;
    }

#ifdef EMIT
    uint next = index < triangleCount ? firstPair[index] + groupPairs[gl_WorkGroupID.x] : 0u;
    if (index < triangleCount) firstPair[index] = next;
#endif
    uint count = 0u;
    for (uint i = 0u; inUse && i < nodeCount;) {
        if (outside(nodes[i], a, b, c)) {
            i = nodes[i].link.x;
            continue;
        }
        if (nodes[i].link.y != NO_PIECE) {
#ifdef EMIT
            if (next + count < capacity)
                pairs[next + count] = uvec2(triangle | (behind ? SEEN_FROM_BEHIND : 0u), nodes[i].link.y);
#endif
            ++count;
        }
        ++i;
    }
#ifdef COUNT
    uint before = groupPrefix(count);
    if (index < triangleCount) firstPair[index] = before;
    if (gl_LocalInvocationIndex == GROUP_SIZE - 1u) groupPairs[gl_WorkGroupID.x] = before + count;
#endif
}
