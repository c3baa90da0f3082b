// Light and colour, once for the shaders and for the reference. Legal GLSL and legal C++ under GLM:
// `f` on every literal, no swizzles, no out parameters. C++ includes it through renderer/shading.h.

// One sun and a sky that is brighter above, in linear light; the scene's y axis is up.
SHARED_FN vec3 sunDirection() { return vec3(0.4082483f, 0.8164966f, 0.4082483f); }

// Light that reaches a surface with this normal (length one, turned to the eye), linear, per channel.
SHARED_FN vec3 lightOnSurface(vec3 normal) {
    float sun = max(dot(normal, sunDirection()), 0.0f);
    float sky = 0.5f + 0.5f * normal.y;
    return 0.75f * sun * vec3(1.0f, 0.96f, 0.88f) + (0.18f + 0.22f * sky) * vec3(0.86f, 0.93f, 1.0f);
}
