// Whether a whole meshlet is seen from behind, once for the shaders and for C++. Legal GLSL and legal C++
// under GLM, as shaders/shading.glsl; C++ includes it through renderer/meshlets.h.

// A triangle with normal n is seen from behind where (p - eye) . n > 0 for its points p. With every normal
// within an angle of `axis` and (centre - p) . n <= reach, that holds for all triangles of a meshlet where
// the direction from the eye to its centre is that near to all the normals: |fromEye| cos(off the axis +
// angle) > reach. Axis of length one.
SHARED_FN bool isMeshletBehind(vec3 fromEye, vec3 axis, float angleSine, float angleCosine, float reach) {
    float along = dot(fromEye, axis);
    float across = length(cross(fromEye, axis));
    // What single precision may lose: an edge-on meshlet stays.
    float slack = 2e-6f * length(fromEye);
    return along * angleCosine - across * angleSine > reach + slack;
}
