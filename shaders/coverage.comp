// Which pieces does each triangle touch? Run twice a frame: COUNT, and after scan.comp EMIT, which writes the pairs in
// scene order so that the same request draws the same picture. Lorenz and Doellner (2009), section 2.1, count in pass 1
// and replicate in pass 2; here a tree over the pieces takes the place of their regular grid.

#include "scene_geometry.glsl"

layout(local_size_x = GROUP_SIZE) in;

struct ConeNode {
    vec4 planes[6];  // xyz: through the eye; zero beyond the last
    uvec4 link;      // x: the node after this subtree, y: the piece of a leaf or NO_PIECE, z: how many planes
};
const uint NO_PIECE = 0xffffffffu;
const uint SEEN_FROM_BEHIND = 0x80000000u;
const uint KEPT = 3u;  // pieces of a triangle that need no second walk; most triangles touch fewer

layout(std430, binding = 2) readonly buffer Nodes { ConeNode nodes[]; };
layout(std430, binding = 3) readonly buffer SingleSided { uint singleSided[]; };  // one bit a triangle
layout(std430, binding = 4) buffer GroupPairs { uint groupPairs[]; };   // COUNT: pairs of a group; EMIT: its first
layout(std430, binding = 5) buffer FirstPair { uint firstPair[]; };     // of each triangle, and of the one after the last
layout(std430, binding = 6) writeonly buffer Pairs { uvec2 pairs[]; };  // triangle and facing, piece
layout(std430, binding = 7) buffer Found { uvec4 found[]; };            // KEPT pieces of each triangle, count and facing

layout(location = 2) uniform uint firstTriangle;
layout(location = 3) uniform uint triangleCount;
layout(location = 4) uniform uint nodeCount;
layout(location = 5) uniform uint capacity;  // of `pairs`; what lies beyond is drawn in another part

shared uint sums[GROUP_SIZE];

bool isBehind(vec3 plane, vec3 a, vec3 b, vec3 c) { return max(max(dot(plane, a), dot(plane, b)), dot(plane, c)) < 0.0; }

// No loop to link.z: with one, llvmpipe (Mesa 22.3) does not come out of the loop in walk().
bool outside(ConeNode node, vec3 a, vec3 b, vec3 c) {
    for (int i = 0; i < 4; ++i) {
        if (isBehind(node.planes[i].xyz, a, b, c)) return true;
    }
    if (node.link.z <= 4u) return false;
    return isBehind(node.planes[4].xyz, a, b, c) || isBehind(node.planes[5].xyz, a, b, c);
}

vec3 cornerRay(uint triangle, uint corner) { return rayToVertex(corners[3u * triangle + corner]); }

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

#ifdef COUNT
uvec3 kept = uvec3(0u);  // the first pieces of this invocation's triangle

void take(uint piece, uint nth) {
    if (nth < KEPT) kept[nth] = piece;
}
#else
uint next;  // pair of this invocation's triangle
uint triangleAndFacing;

void take(uint piece, uint nth) {
    if (next + nth < capacity) pairs[next + nth] = uvec2(triangleAndFacing, piece);
}
#endif

// Takes every piece that the triangle may touch, and counts them.
uint walk(uint triangle) {
    vec3 a = cornerRay(triangle, 0u), b = cornerRay(triangle, 1u), c = cornerRay(triangle, 2u);
    uint count = 0u;
    for (uint i = 0u; i < nodeCount;) {
        if (outside(nodes[i], a, b, c)) {
            i = nodes[i].link.x;
            continue;
        }
        if (nodes[i].link.y != NO_PIECE) take(nodes[i].link.y, count++);
        ++i;
    }
    return count;
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    uint triangle = firstTriangle + index;
#ifdef COUNT
    uint count = 0u;
    if (index < triangleCount) {
        vec3 a = cornerRay(triangle, 0u), b = cornerRay(triangle, 1u), c = cornerRay(triangle, 2u);
        // Facing is a property of the triangle and the eye, not of any piece's screen. This is det(a, b, c) without
        // its cancellation, which gives a small triangle far away either sign.
        bool behind = dot(a, cross(b - a, c - a)) > 0.0;
        if (!behind || (singleSided[triangle / 32u] >> (triangle % 32u) & 1u) == 0u)
            count = walk(triangle);
        found[index] = uvec4(kept, count | (behind ? SEEN_FROM_BEHIND : 0u));
    }
    uint before = groupPrefix(count);
    if (index < triangleCount) firstPair[index] = before;
    if (gl_LocalInvocationIndex == GROUP_SIZE - 1u) groupPairs[gl_WorkGroupID.x] = before + count;
#else
    if (index >= triangleCount) return;
    next = firstPair[index] + groupPairs[gl_WorkGroupID.x];
    firstPair[index] = next;
    uint count = found[index].w & ~SEEN_FROM_BEHIND;
    triangleAndFacing = triangle | (found[index].w & SEEN_FROM_BEHIND);
    if (count > KEPT) {
        walk(triangle);
    } else {
        for (uint i = 0u; i < count; ++i) take(found[index][i], i);
    }
#endif
}
