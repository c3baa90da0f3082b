// For the styles that draw edges: how wide a triangle's lines are. Edge i of a triangle lies opposite corner i.

#include "line_styles.glsl"

// As renderer/edge_neighbours.h gives it: the corner that the triangle across edge i has off that edge, or one of these.
const uint NOTHING_ACROSS = 0xffffffffu;
const uint CREASE = 0x80000000u;
const uint ELSEWHERE = 0x7fffffffu;  // the corner is not in these buffers
layout(std430, binding = 7) readonly buffer Across { uint across[]; };  // three a triangle

// On the line through the edge's ends, seen from the eye, do both triangles lie on one side?
bool isSilhouette(vec3 from, vec3 to, vec3 corner, uint otherCorner) {
    if (otherCorner == ELSEWHERE) return false;
    vec3 plane = cross(from, to - from);
    return dot(plane, corner - from) * dot(plane, rayToVertex(otherCorner) - from) > 0.0;
}

float widthOfEdgePx(vec3 from, vec3 to, vec3 corner, uint beyond) {
    bool fold = (beyond & CREASE) != 0u;  // or nothing across
    bool silhouette = beyond != NOTHING_ACROSS && isSilhouette(from, to, corner, beyond & ~CREASE);
#ifdef WIREFRAME
    return wireWidthPx(silhouette);
#else
    return outlineWidthPx(silhouette, fold);
#endif
}

vec3 widthsOfEdgesPx(uint triangle) {
    uint first = 3u * triangle;
    vec3 a = rayToVertex(corners[first]), b = rayToVertex(corners[first + 1u]), c = rayToVertex(corners[first + 2u]);
    return vec3(widthOfEdgePx(b, c, a, across[first]), widthOfEdgePx(c, a, b, across[first + 1u]),
                widthOfEdgePx(a, b, c, across[first + 2u]));
}
