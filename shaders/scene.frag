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
layout(binding = 1) uniform isampler2DArray owners;  // the piece that owns each sample, -1 in holes
layout(location = 17) uniform int firstOwnerLayer;
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
    int owned = 0;
    for (int i = 0; i < OWNER_SAMPLES; ++i) {
        if (texelFetch(owners, ivec3(gl_FragCoord.xy, firstOwnerLayer + i), 0).r == ownPiece) owned |= 1 << i;
    }
    if (owned == 0) discard;
#if OWNER_SAMPLES > 1
    gl_SampleMask[0] = owned;
#endif
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
#ifdef BLENDED
    result = vec4(color, base.a);
#else
    result = vec4(color, 1.0);
#endif
#endif
}
