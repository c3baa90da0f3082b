// Whether a display shows something of a sphere, in the words of meshlets.comp: one node, or none.

#include "screen_map.glsl"

uvec2 nodesTouched(vec3 centre, float radius) {
    float apart = length(centre);
    radius += 1e-6 * apart;
    if (radius >= apart) return uvec2(0u, 1u);
    float sine = radius / apart;
    return uvec2(0u, isBesideDisplay(centre / apart, sine, sqrt(1.0 - sine * sine)) ? 0u : 1u);
}
