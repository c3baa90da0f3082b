// The tree over the pieces, as buildPieceTree in calibration/pieces/piece_tree.h makes it.

struct ConeNode {
    vec4 planes[6];  // xyz: through the eye, length one; zero beyond the last
    uvec4 link;      // x: the node after this subtree, y: the piece of a leaf or NO_PIECE, z: how many planes
};

layout(std430, binding = 2) readonly buffer Nodes { ConeNode nodes[]; };
layout(location = 4) uniform uint nodeCount;
