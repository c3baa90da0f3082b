// A corner for bounded.geom, from the eye. The axes that `wallFromScene` leads to are the lens's: x right, y up, ahead is
// -z. Programs of several materials share corners, which must have the same bits in all of them.

#include "scene_geometry.glsl"
#ifdef EDGES
#include "edge_widths.glsl"
layout(location = 2) flat out vec3 edgeWidthsPx;
#endif

layout(location = 0) invariant out vec3 corner;
layout(location = 1) flat out uint cornerVertex;

void main() {
#ifdef EDGES
    cornerVertex = corners[gl_VertexID];
    edgeWidthsPx = widthsOfEdgesPx(uint(gl_VertexID) / 3u);
#else
    cornerVertex = uint(gl_VertexID);
#endif
    corner = rayToVertex(cornerVertex);
}
