// For the styles that draw edges: what scene.vert sends along with a corner. Edge i of a triangle lies opposite corner i.

#include "edge_widths.glsl"

// Barycentric: weight i is 0 on edge i.
layout(location = 4) out vec3 weights;
layout(location = 5) flat out vec3 edgeWidthsPx;

void sendEdges(uint triangle, uint corner) {
    weights = vec3(corner == 0u, corner == 1u, corner == 2u);
    edgeWidthsPx = widthsOfEdgesPx(triangle);
}
