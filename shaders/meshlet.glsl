// A run of up to 64 triangles of one material that lie close together; see renderer/meshlets.h.

struct Meshlet {
    vec4 sphere;  // centre, relative to the scene's origin, and radius
    vec4 cone;    // axis and cutoff of the normals, scene axes; cutoff above 1 where they cannot tell the side
    uint firstTriangle;
    uint triangleCount;
    uint isSingleSided;
    uint reserved;
};
layout(std430, binding = 3) readonly buffer Meshlets { Meshlet meshlets[]; };
