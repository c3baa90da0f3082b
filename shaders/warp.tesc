// Hands a part to the tessellator. How often an edge is divided follows from its two ends alone.

layout(vertices = 3) out;

layout(location = 0) in vec3 ray[];
layout(location = 0) out vec3 rayOfCorner[];
#ifdef LIT
layout(location = 1) in vec3 normal[];
layout(location = 1) out vec3 normalOfCorner[];
#endif
#ifdef TEXTURED
layout(location = 2) in vec2 uv[];
layout(location = 2) out vec2 uvOfCorner[];
#endif
#ifdef EDGES
layout(location = 4) in vec3 weights[];
layout(location = 4) out vec3 weightsOfCorner[];
layout(location = 5) in vec3 edgeWidthsPx[];
layout(location = 5) patch out vec3 edgeWidthsOfPart;
#endif
layout(location = 6) in vec3 referenceAndLevel[];
layout(location = 7) patch out vec2 reference;

void main() {
    rayOfCorner[gl_InvocationID] = ray[gl_InvocationID];
#ifdef LIT
    normalOfCorner[gl_InvocationID] = normal[gl_InvocationID];
#endif
#ifdef TEXTURED
    uvOfCorner[gl_InvocationID] = uv[gl_InvocationID];
#endif
#ifdef EDGES
    weightsOfCorner[gl_InvocationID] = weights[gl_InvocationID];
    edgeWidthsOfPart = edgeWidthsPx[0];
#endif
    reference = referenceAndLevel[0].xy;
    float ab = referenceAndLevel[2].z, bc = referenceAndLevel[0].z, ca = referenceAndLevel[1].z;
    gl_TessLevelOuter[0] = bc;
    gl_TessLevelOuter[1] = ca;
    gl_TessLevelOuter[2] = ab;
    gl_TessLevelInner[0] = max(max(ab, bc), ca);
}
