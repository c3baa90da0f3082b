// What a frame shows where a ray meets a surface, whichever way that was found.

#include "shading.glsl"

#ifdef EDGES
#include "line_styles.glsl"
layout(location = 22) uniform vec3 sampling;  // xy: how far right and down the picture is drawn, z: side of a sample, px
#endif
#ifdef TEXTURED
layout(binding = 0) uniform sampler2D baseColorTexture;
#endif
layout(location = 10) uniform vec4 baseColor;
layout(location = 11) uniform float alphaCutoff;

layout(location = 0) out vec4 result;

struct Surface {
    vec3 ray;  // from the eye to the point shown, wall axes, metres
    vec4 texel;
    vec3 normal;  // scene axes, of any length
    bool isSeenFromBehind;
    float line;  // share of the sample that lines along edges cover
};

// Sets the result, or discards it.
void show(Surface surface) {
    vec4 base = baseColor;
#ifdef TEXTURED
    base *= surface.texel;
#endif
#ifdef MASKED
    if (base.a < alphaCutoff) discard;
#endif

#if defined(OUTPUT_DEPTH)
    result = vec4(length(surface.ray), 0.0, 0.0, 1.0);
#elif defined(OUTPUT_COVERAGE)
    result = vec4(1.0, 0.0, 0.0, 1.0);
#elif defined(OUTPUT_POSITION)
    result = vec4(surface.ray, 1.0);
#else
    vec3 color = base.rgb;
#ifdef LIT
    vec3 n = normalize(surface.normal);
    if (surface.isSeenFromBehind) n = -n;
    color *= lightOnSurface(n);
#endif
#ifdef EDGES
#ifdef WIREFRAME
    color = wireframeColor(color, surface.line);
#else
    color = penAndInkColor(color, gl_FragCoord.xy - sampling.xy, surface.line, sampling.z);
#endif
#endif
#ifdef BLENDED
    result = vec4(color, base.a);
#else
    result = vec4(color, 1.0);
#endif
#endif
}
