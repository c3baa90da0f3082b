// The nodes of the piece tree between which a sphere's lie, by a walk over the tree.

#include "piece_tree.glsl"

bool isOutside(ConeNode node, vec3 centre, float radius) {
    for (int i = 0; i < 6; ++i) {
        if (dot(node.planes[i].xyz, centre) < -radius) return true;
    }
    return false;
}

uvec2 nodesTouched(vec3 centre, float radius) {
    // What the subtraction of the eye rounds off is a share of the distance.
    radius += 1e-6 * length(centre);
    uvec2 touched = uvec2(nodeCount, 0u);
    for (uint i = 0u; i < nodeCount;) {
        if (isOutside(nodes[i], centre, radius)) {
            i = max(nodes[i].link.x, i + 1u);  // as in walk()
            continue;
        }
        if (nodes[i].link.y != NO_PIECE) touched = uvec2(min(touched.x, i), i + 1u);
        ++i;
    }
    return touched;
}
