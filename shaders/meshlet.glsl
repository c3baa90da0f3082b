// A run of up to 64 triangles of one material that lie close together; see renderer/meshlets.h.

struct Meshlet {
    vec4 sphere;  // centre, relative to the scene's origin, and radius
    vec4 cone;    // of the normals: axis, scene axes, and reach; see meshlet_cone.glsl
    uint firstTriangle;
    uint triangleCount;
    uint isSingleSided;
    float coneSine;
    float coneCosine;
    uint reserved[3];
};
layout(std430, binding = 3) readonly buffer Meshlets { Meshlet meshlets[]; };
