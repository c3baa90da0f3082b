// The coarse level of coverage: which meshlets show something, and which part of the piece tree is theirs. MARK looks at
// each, scan.comp counts, GATHER lists those that are left, in order. MARK walks the tree, or with GRID looks at a few cells,
// or with WARP at the cone of what the display shows.

#include "scene_geometry.glsl"
#include "meshlet.glsl"
#include "meshlet_cone.glsl"

layout(local_size_x = GROUP_SIZE) in;

layout(std430, binding = 4) buffer GroupSeen { uint groupSeen[]; };  // MARK: how many of a group; GATHER: the first's place
layout(std430, binding = 5) buffer MeshletNodes { uvec2 meshletNodes[]; };  // from x up to y; empty: it shows nothing
layout(std430, binding = 10) writeonly buffer Seen { uint seen[]; };        // meshlets, in order
layout(std430, binding = 11) buffer PlaceOf { uint placeOf[]; };  // of each meshlet and the one after the last, in `seen`

layout(location = 3) uniform uint firstMeshlet;
layout(location = 5) uniform uint meshletCount;

#ifdef MARK
#include "group_prefix.glsl"
#if defined(GRID)
#include "grid_lookup.glsl"
#elif defined(WARP)
#include "warp_lookup.glsl"
#else
#include "tree_lookup.glsl"
#endif

bool isSeenFromBehind(Meshlet m, vec3 centre) {
    return m.isSingleSided != 0u &&
           isMeshletBehind(centre, wallFromScene * m.cone.xyz, m.coneSine, m.coneCosine, m.cone.w);
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    bool isSeen = false;
    if (index < meshletCount) {
        Meshlet m = meshlets[firstMeshlet + index];
        vec3 centre = rayTo(m.sphere.xyz);
        uvec2 touched = uvec2(0u);
        if (!isSeenFromBehind(m, centre)) touched = nodesTouched(centre, m.sphere.w);
        isSeen = touched.x < touched.y;
        meshletNodes[index] = isSeen ? touched : uvec2(0u);
    }
    uint before = groupPrefix(isSeen ? 1u : 0u);
    if (index < meshletCount) placeOf[index] = before;
    if (gl_LocalInvocationIndex == GROUP_SIZE - 1u) groupSeen[gl_WorkGroupID.x] = before + (isSeen ? 1u : 0u);
}
#else
void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= meshletCount) return;
    uint place = placeOf[index] + groupSeen[gl_WorkGroupID.x];
    placeOf[index] = place;
    bool isSeen = meshletNodes[index].x < meshletNodes[index].y;
    if (isSeen) seen[place] = index;
    if (index + 1u == meshletCount) placeOf[meshletCount] = place + (isSeen ? 1u : 0u);
}
#endif
