// A vertex that the tessellator has made: where in the scene it is, and where the display shows that.

#include "warp_geometry.glsl"

layout(triangles, equal_spacing, ccw) in;

layout(location = 0) in vec3 rayOfCorner[];
layout(location = 0) out vec3 ray;
#ifdef LIT
layout(location = 1) in vec3 normalOfCorner[];
layout(location = 1) out vec3 normal;
#endif
#ifdef TEXTURED
layout(location = 2) in vec2 uvOfCorner[];
layout(location = 2) out vec2 uv;
#endif
#ifdef OWNED
layout(location = 3) flat out int ownPiece;
#endif
#ifdef EDGES
layout(location = 4) in vec3 weightsOfCorner[];
layout(location = 4) out vec3 weights;
layout(location = 5) patch in vec3 edgeWidthsOfPart;
layout(location = 5) flat out vec3 edgeWidthsPx;
#endif
layout(location = 7) patch in vec2 reference;

#include "warp_landing.glsl"

void main() {
    vec3 a = rayOfCorner[0], b = rayOfCorner[1], c = rayOfCorner[2];
    ray = pointWithin(a, b, c, gl_TessCoord);
    vec3 shares = sharesWithin(a, b, c, gl_TessCoord);
#ifdef LIT
    normal = shares.x * normalOfCorner[0] + shares.y * normalOfCorner[1] + shares.z * normalOfCorner[2];
#endif
#ifdef TEXTURED
    uv = shares.x * uvOfCorner[0] + shares.y * uvOfCorner[1] + shares.z * uvOfCorner[2];
#endif
#ifdef OWNED
    ownPiece = 0;
#endif
#ifdef EDGES
    weights = shares.x * weightsOfCorner[0] + shares.y * weightsOfCorner[1] + shares.z * weightsOfCorner[2];
    edgeWidthsPx = edgeWidthsOfPart;
#endif
    landNear(ray, reference);
}
