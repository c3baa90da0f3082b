// The fine level of coverage: which pieces does each triangle of a meshlet touch? Run twice a frame: COUNT, and after
// scan.comp EMIT, which writes the pairs in scene order so that the same request draws the same picture. Lorenz and Doellner
// (2009), section 2.1, count in pass 1 and replicate in pass 2; here a tree over the pieces takes the place of their regular
// grid. One group a meshlet. WARP: for vertex-warp, the parts of each triangle rather than pieces.

layout(local_size_x = GROUP_SIZE) in;

#ifdef WARP
#include "warp_parts.glsl"
layout(std430, binding = 8) writeonly buffer Parts { uvec2 parts[]; };  // of each pair: the part's three corners, where divided
#else
#include "piece_coverage.glsl"
#endif
#include "meshlet.glsl"
#include "group_prefix.glsl"

const uint KEPT = 3u;  // pieces of a triangle that need no second walk; most triangles touch fewer

layout(std430, binding = 4) buffer GroupPairs { uint groupPairs[]; };   // COUNT: pairs of a group; EMIT: its first
layout(std430, binding = 5) readonly buffer MeshletNodes { uvec2 meshletNodes[]; };
layout(std430, binding = 6) writeonly buffer Pairs { uvec2 pairs[]; };  // triangle and facing, piece
layout(std430, binding = 7) buffer Found { uvec4 found[]; };            // KEPT pieces of each triangle, count and facing
layout(std430, binding = 10) readonly buffer Seen { uint seen[]; };     // meshlets that show something

#if defined(WARP) && defined(COUNT)
layout(std430, binding = 13) buffer Totals { uint totals[]; };  // of each part, as renderer/coverage.h has them
layout(location = 7) uniform uint part;
#endif

layout(location = 3) uniform uint firstMeshlet;
layout(location = 5) uniform uint capacity;  // of `pairs`; what lies beyond is drawn in another part

#ifdef COUNT
uvec3 kept = uvec3(0u);  // the first pieces of this invocation's triangle

void take(uint piece, uint nth) {
    if (nth < KEPT) kept[nth] = piece;
}

// The triangle's pieces: how many, and in the highest bit its facing, which is a matter of the triangle and the eye and not
// of any piece's screen.
uint count(uint triangle, bool isSingleSided, uvec2 nodeRange) {
    RayTriangle t = rayTriangleAt(triangle);
    bool behind = t.facing > 0.0;
    if (behind && isSingleSided) return 0u;
    uint pieces = walk(t, nodeRange.x, nodeRange.y, ALL_PIECES);
#ifdef WARP
    if (refusal != 0u) pieces = 0u;  // nobody sees the frame, which need not take long then
#endif
    return pieces | (behind ? SEEN_FROM_BEHIND : 0u);
}
#else
uint next, most;  // pair of this invocation's triangle, and how many it has
uint triangleAndFacing;

void take(uint piece, uint nth) {
    if (next + nth >= capacity) return;
    pairs[next + nth] = uvec2(triangleAndFacing, piece);
#ifdef WARP
    for (uint i = 0u; i < 3u; ++i) parts[3u * (next + nth) + i] = taken.corners[i];
#endif
}
#endif

void main() {
    uint self = gl_LocalInvocationIndex, slot = gl_WorkGroupID.x * GROUP_SIZE + self;
    uint index = seen[gl_WorkGroupID.x];
    Meshlet m = meshlets[firstMeshlet + index];
    bool isTriangle = self < m.triangleCount;
#ifdef COUNT
    uint counted = isTriangle ? count(m.firstTriangle + self, m.isSingleSided != 0u, meshletNodes[index]) : 0u;
    found[slot] = uvec4(kept, counted);
#ifdef WARP
    if (refusal != 0u) atomicMax(totals[3u * part + 2u], refusal);
#endif
    uint pairCount = counted & ~SEEN_FROM_BEHIND;
    uint before = groupPrefix(pairCount);
    if (self == GROUP_SIZE - 1u) groupPairs[gl_WorkGroupID.x] = before + pairCount;
#else
    uvec4 ofTriangle = found[slot];
    most = ofTriangle.w & ~SEEN_FROM_BEHIND;
    next = groupPairs[gl_WorkGroupID.x] + groupPrefix(most);
    triangleAndFacing = (m.firstTriangle + self) | (ofTriangle.w & SEEN_FROM_BEHIND);
#ifdef WARP
    bool isKept = most <= KEPT && (ofTriangle.x & IS_DIVIDED) == 0u;
#else
    bool isKept = most <= KEPT;
#endif
    if (!isKept) {
        // Two programs need not round alike: for a piece that this walk misses nothing is drawn.
        uint again = walk(rayTriangleAt(m.firstTriangle + self), meshletNodes[index].x, meshletNodes[index].y,
                          most);
        for (uint i = again; i < most; ++i) take(NO_PIECE, i);
    } else {
        for (uint i = 0u; i < most; ++i) take(ofTriangle[i], i);
    }
#endif
}
