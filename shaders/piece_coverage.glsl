// Does a triangle touch a piece? Both are convex cones at the eye. Two of them are apart exactly when a plane of one of them
// has the other behind it (the separating axis theorem on the sphere of directions), so pieces bring their edge planes and
// triangles theirs. Pieces have their guard about them, which is larger than what rounding moves.

#include "scene_geometry.glsl"
#include "piece_tree.glsl"

layout(std430, binding = 8) readonly buffer PieceCorners { vec4 pieceCorners[]; };  // six of each piece, the last repeated
layout(std430, binding = 9) readonly buffer PieceRows { vec4 pieceRows[]; };        // as scene_corner.glsl reads them

layout(location = 19) uniform uint rowsPerPiece;
// Where samples lie: clip space times xy plus zw is whole at every sample. Zero where what meets no sample counts as well.
layout(location = 16) uniform vec4 sampleGrid;

const uint ALL_PIECES = 0xffffffffu;
const uint SEEN_FROM_BEHIND = 0x80000000u;  // a triangle's facing, beside its index

struct RayTriangle {
    vec3 a, b, c;     // from the eye to the corners
    vec3 inward[3];   // planes through the eye and an edge; the triangle's cone is where none is negative
    float facing;     // det(a, b, c): positive seen from behind
};

RayTriangle rayTriangle(vec3 a, vec3 b, vec3 c) {
    // Without the cancellation of det(a, b, c), which gives a small triangle far away either sign; the planes likewise.
    float facing = dot(a, cross(b - a, c - a));
    float side = facing < 0.0 ? -1.0 : 1.0;
    return RayTriangle(a, b, c, vec3[3](side * cross(a, b - a), side * cross(b, c - b), side * cross(c, a - c)), facing);
}

RayTriangle rayTriangleAt(uint triangle) {
    return rayTriangle(rayToVertex(corners[3u * triangle]), rayToVertex(corners[3u * triangle + 1u]),
                       rayToVertex(corners[3u * triangle + 2u]));
}

bool isBehind(vec3 plane, RayTriangle t) { return max(max(dot(plane, t.a), dot(plane, t.b)), dot(plane, t.c)) < 0.0; }

// No loop to link.z: with one, llvmpipe (Mesa 22.3) does not come out of the loop in walk().
bool isOutside(ConeNode node, RayTriangle t) {
    for (int i = 0; i < 4; ++i) {
        if (isBehind(node.planes[i].xyz, t)) return true;
    }
    if (node.link.z <= 4u) return false;
    return isBehind(node.planes[4].xyz, t) || isBehind(node.planes[5].xyz, t);
}

bool isPieceBehind(vec3 plane, uint piece, uint edges) {
    uint first = 6u * piece;
    float most = max(dot(plane, pieceCorners[first].xyz), dot(plane, pieceCorners[first + 1u].xyz));
    most = max(most, max(dot(plane, pieceCorners[first + 2u].xyz), dot(plane, pieceCorners[first + 3u].xyz)));
    if (edges > 4u) most = max(most, max(dot(plane, pieceCorners[first + 4u].xyz), dot(plane, pieceCorners[first + 5u].xyz)));
    return most < 0.0;
}

// A triangle so small that it lies between the samples shows nothing. The rasterizer rounds corners to 1/256 px.
bool liesBetweenSamples(uint piece, RayTriangle t) {
    if (sampleGrid.x == 0.0) return false;
    vec3 x = pieceRows[rowsPerPiece * piece].xyz, y = pieceRows[rowsPerPiece * piece + 1u].xyz,
         w = pieceRows[rowsPerPiece * piece + 2u].xyz;
    vec3 ws = vec3(dot(w, t.a), dot(w, t.b), dot(w, t.c));
    if (min(min(ws.x, ws.y), ws.z) <= 0.0) return false;
    vec2 a = vec2(dot(x, t.a), dot(y, t.a)) / ws.x, b = vec2(dot(x, t.b), dot(y, t.b)) / ws.y,
         c = vec2(dot(x, t.c), dot(y, t.c)) / ws.z;
    const float rounding = 1.0 / 64.0;
    vec2 least = min(min(a, b), c) * sampleGrid.xy + sampleGrid.zw - rounding;
    vec2 most = max(max(a, b), c) * sampleGrid.xy + sampleGrid.zw + rounding;
    return any(greaterThan(ceil(least), most));
}

bool touches(ConeNode leaf, RayTriangle t) {
    // A line or a point as a triangle has no inside.
    if (t.facing != 0.0) {
        for (int i = 0; i < 3; ++i) {
            if (isPieceBehind(t.inward[i], leaf.link.y, leaf.link.z)) return false;
        }
    }
    return !liesBetweenSamples(leaf.link.y, t);
}

void take(uint piece, uint nth);  // what the includer does with the nth piece

// Takes the node's piece, if it has one that the triangle touches, and tells which node comes next.
uint visit(uint node, RayTriangle t, uint begin, inout uint count) {
    // Always onwards: the vertices that fill up llvmpipe's last vector read zeros, and would go round for long.
    if (nodes[node].link.x <= begin || isOutside(nodes[node], t)) return max(nodes[node].link.x, node + 1u);
    if (nodes[node].link.y != NO_PIECE && touches(nodes[node], t)) take(nodes[node].link.y, count++);
    return node + 1u;
}

// Takes the pieces that the triangle touches among the nodes from begin up to end, `most` of them, and counts them. It starts
// at the root: the planes about several pieces leave out a little more than those about each. Four nodes a round, for llvmpipe
// (Mesa 22.3) ends all loops of a shader once they have gone round 65,535 times together: see kMostWalkedNodes.
uint walk(RayTriangle t, uint begin, uint end, uint most) {
    uint count = 0u;
    for (uint i = 0u; i < end && count < most;) {
        i = visit(i, t, begin, count);
        if (i < end && count < most) i = visit(i, t, begin, count);
        if (i < end && count < most) i = visit(i, t, begin, count);
        if (i < end && count < most) i = visit(i, t, begin, count);
    }
    return count;
}
