// What a frame shows at a fragment. It knows nothing of pieces but, where single cover matters, whose pixel it is.

#include "surface.glsl"

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
layout(location = 4) in vec3 weights;  // barycentric: weight i is 0 on edge i
layout(location = 5) flat in vec3 edgeWidthsPx;

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

#ifdef CHECK_FACING
layout(location = 12) uniform bool frontIsClockwise;  // one piece: facing follows from its orientation on the screen
#endif

void main() {
    Surface surface = Surface(ray, vec4(1.0), vec3(0.0), false, 0.0);
#ifdef EDGES
    surface.line = coverageByEdges();  // before anything is discarded: derivatives need their neighbours
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
    surface.isSeenFromBehind = gl_FrontFacing == frontIsClockwise;
#ifdef SINGLE_SIDED
    if (surface.isSeenFromBehind) discard;
#endif
#endif
#ifdef LIT
    surface.normal = normal;
#endif
#ifdef TEXTURED
    surface.texel = texture(baseColorTexture, uv);
#endif
    show(surface);
}
