// What a display that overlaps its neighbours shows of a picture, once for the shaders and for the reference.
// Legal GLSL and legal C++ under GLM; C++ includes it through renderer/blending.h.

// The blending of MPCDI, in linear light: `alpha` takes light away, `beta` lifts black. Light above `most`,
// which the output could not have shown without maps either, is cut first, or the sum of two displays would
// be brighter than one.
SHARED_FN vec3 blended(vec3 color, vec3 alpha, vec3 beta, float most) {
    return min(color, vec3(most)) * alpha * (vec3(1.0f) - beta) + beta;
}
