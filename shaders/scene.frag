// What a frame shows at a fragment. It knows nothing of pieces but, where single cover matters, whose pixel it is.

#include "shading.glsl"

layout(location = 0) in vec3 ray;  // from the eye to the point shown, wall axes, metres
#ifdef LIT
layout(location = 1) in vec3 normal;  // scene axes
#endif
#ifdef TEXTURED
layout(location = 2) in vec2 uv;
#endif
#ifdef OWNED
layout(location = 3) flat in int ownPiece;
#endif
#if defined(OWNED) || defined(HOLES)
layout(binding = 1) uniform isampler2D owners;  // the piece that owns each pixel, -1 in holes
#endif

#ifdef TEXTURED
layout(binding = 0) uniform sampler2D baseColorTexture;
#endif
layout(location = 10) uniform vec4 baseColor;
layout(location = 11) uniform float alphaCutoff;
#ifdef CHECK_FACING
layout(location = 12) uniform bool frontIsClockwise;  // one piece: facing follows from its orientation on the screen
#endif

layout(location = 0) out vec4 result;

void main() {
#ifdef OWNED
    if (texelFetch(owners, ivec2(gl_FragCoord.xy), 0).r != ownPiece) discard;
#endif
#ifdef HOLES
    if (texelFetch(owners, ivec2(gl_FragCoord.xy), 0).r < 0) discard;
#endif
#ifdef CHECK_FACING
    bool behind = gl_FrontFacing == frontIsClockwise;
#ifdef SINGLE_SIDED
    if (behind) discard;
#endif
#endif
    vec4 base = baseColor;
#ifdef TEXTURED
    base *= texture(baseColorTexture, uv);
#endif
#ifdef MASKED
    if (base.a < alphaCutoff) discard;
#endif

#if defined(OUTPUT_DEPTH)
    result = vec4(length(ray), 0.0, 0.0, 1.0);
#elif defined(OUTPUT_COVERAGE)
    result = vec4(1.0, 0.0, 0.0, 1.0);
#elif defined(OUTPUT_POSITION)
    result = vec4(ray, 1.0);
#else
    vec3 color = base.rgb;
#ifdef LIT
    vec3 n = normalize(normal);
#ifdef CHECK_FACING
    if (behind) n = -n;
#endif
    color *= lightOnSurface(n);
#endif
    result = vec4(color, 1.0);
#endif
}
