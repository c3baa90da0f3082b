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

#ifdef EDGES
#include "line_styles.glsl"
layout(location = 4) in vec3 weights;  // barycentric: weight i is 0 on edge i
layout(location = 5) flat in vec3 edgeWidthsPx;
layout(location = 22) uniform vec3 sampling;  // xy: how far right and down the picture is drawn, z: side of a sample, px

// Weights are affine in the point; divided by w they are so on the screen of a piece, where the distance to each edge
// is exact therefore. Pieces differ in w and in scale, which drop out (Baerentzen et al., Single-pass Wireframe
// Rendering, 2006, has the widths by edge lengths on the screen, for which no corner may lie behind the eye).
float coverageByEdges() {
    vec3 onScreen = weights * gl_FragCoord.w;
    vec3 across = dFdx(onScreen), down = dFdy(onScreen);
    float most = 0.0;
    for (int i = 0; i < 3; ++i) {
        float distancePx = distanceToLinePx(onScreen[i], vec2(across[i], down[i]));
        most = max(most, strokeCoverage(distancePx, edgeWidthsPx[i], sampling.z));
    }
    return most;
}
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
#ifdef EDGES
    float line = coverageByEdges();  // before anything is discarded: derivatives need their neighbours
#endif
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
#ifdef EDGES
#ifdef WIREFRAME
    color = wireframeColor(color, line);
#else
    color = penAndInkColor(color, gl_FragCoord.xy - sampling.xy, line, sampling.z);
#endif
#endif
#ifdef BLENDED
    result = vec4(color, base.a);
#else
    result = vec4(color, 1.0);
#endif
#endif
}
