// Draws a triangle into those of the pictures that it touches, all pictures at once: each has a layer of the target and a
// viewport (Lorenz and Doellner, 2009, measured against a cube drawn this way).

layout(std430, binding = 2) readonly buffer PieceRows { vec4 pieceRows[]; };

#define LANDS_HERE
#include "scene_corner.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 3 * LAYERS) out;

layout(location = 0) in vec3 cornerRay[];
#ifdef LIT
layout(location = 1) in vec3 cornerNormal[];
#endif
#ifdef TEXTURED
layout(location = 2) in vec2 cornerUv[];
#endif
#ifdef EDGES
layout(location = 4) in vec3 cornerWeights[];
layout(location = 5) flat in vec3 cornerEdgeWidthsPx[];
layout(location = 4) out vec3 weights;
layout(location = 5) flat out vec3 edgeWidthsPx;
#endif

bool allNegative(vec3 v) { return max(max(v.x, v.y), v.z) < 0.0; }

bool isBeside(uint picture) {
    mat3 corners = mat3(cornerRay[0], cornerRay[1], cornerRay[2]);
    uint row = 3u * picture;
    vec3 x = pieceRows[row].xyz * corners, y = pieceRows[row + 1u].xyz * corners, w = pieceRows[row + 2u].xyz * corners;
    return allNegative(w - nearFraction) || allNegative(w - x) || allNegative(w + x) || allNegative(w - y) ||
           allNegative(w + y);
}

void main() {
#ifdef SINGLE_SIDED
    if (dot(cornerRay[0], cross(cornerRay[1] - cornerRay[0], cornerRay[2] - cornerRay[0])) > 0.0) return;
#endif
    for (uint picture = 0u; picture < uint(LAYERS); ++picture) {
        if (isBeside(picture)) continue;
        for (int i = 0; i < 3; ++i) {
            ray = cornerRay[i];
#ifdef LIT
            normal = cornerNormal[i];
#endif
#ifdef TEXTURED
            uv = cornerUv[i];
#endif
#ifdef EDGES
            weights = cornerWeights[i];
            edgeWidthsPx = cornerEdgeWidthsPx[i];
#endif
            land(picture);
            gl_Layer = int(picture);
            gl_ViewportIndex = int(picture);
            EmitVertex();
        }
        EndPrimitive();
    }
}
