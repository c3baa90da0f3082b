// The last step of a frame on a display with maps.

#include "blending.glsl"

layout(binding = 0) uniform sampler2D picture;
layout(binding = 1) uniform sampler2D alphaMap;
layout(binding = 2) uniform sampler2D betaMap;
layout(location = 0) uniform float most;

layout(location = 0) out vec4 result;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 alpha = vec3(1.0);
    vec3 beta = vec3(0.0);
#ifdef ALPHA
    alpha = texelFetch(alphaMap, at, 0).rgb;
#endif
#ifdef BETA
    beta = texelFetch(betaMap, at, 0).rgb;
#endif
    result = vec4(blended(texelFetch(picture, at, 0).rgb, alpha, beta, most), 1.0);
}
