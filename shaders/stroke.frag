// The pixels, or samples, that are near enough to a stroke; and what it shows there, which is that of its nearest place.

#include "shading.glsl"

layout(location = 0) flat in vec4 endsPx;
layout(location = 1) flat in vec2 inverseW;
layout(location = 2) flat in vec3 fromRay;
layout(location = 3) flat in vec3 toRay;
layout(location = 4) flat in vec3 shape;
layout(location = 5) flat in vec2 along;
#ifdef SINGLE_COVER
layout(location = 9) flat in vec4 waysOn;
#endif
#ifdef TEXTURED
layout(location = 6) flat in vec4 endUvs;
layout(binding = 0) uniform sampler2D baseColorTexture;
#endif
#ifdef LIT
layout(location = 7) flat in vec3 fromNormal;
layout(location = 8) flat in vec3 toNormal;
#endif
#ifdef HOLES
layout(binding = 1) uniform isampler2DArray owners;  // the piece that owns each pixel, -1 in holes
#endif

layout(location = 9) uniform float nearFraction;
layout(location = 10) uniform vec4 baseColor;
layout(location = 11) uniform float alphaCutoff;
layout(location = 14) uniform vec2 shiftPx;

layout(location = 0) out vec4 result;

void main() {
#ifdef HOLES
    if (texelFetch(owners, ivec3(gl_FragCoord.xy, 0), 0).r < 0) discard;
#endif
    vec2 px = gl_FragCoord.xy - shiftPx;  // of the sample, where there are several
    vec2 way = endsPx.zw - endsPx.xy;
    float squared = dot(way, way);
#ifdef SINGLE_COVER
    // Beyond a cut another piece goes on.
    if (shape.y > 0.0 && dot(px - endsPx.xy, waysOn.xy) < 0.0) discard;
    if (shape.z > 0.0 && dot(px - endsPx.zw, waysOn.zw) >= 0.0) discard;
#endif
    float share = squared > 0.0 ? clamp(dot(px - endsPx.xy, way) / squared, 0.0, 1.0) : 0.0;
    if (distance(px, endsPx.xy + share * way) > shape.x) discard;

    // 1 / w is linear on the screen, and so is what is divided by it.
    float inverse = mix(inverseW.x, inverseW.y, share);
    float weight = share * inverseW.y / inverse;
    float place = mix(along.x, along.y, weight);
    vec3 ray = mix(fromRay, toRay, weight);
    gl_FragDepth = nearFraction * inverse;

    vec4 base = baseColor;
#ifdef TEXTURED
    float weightPerShare = inverseW.x * inverseW.y / (inverse * inverse);
    vec2 placePerPx = squared > 0.0 ? (along.y - along.x) * weightPerShare / squared * way : vec2(0.0);
    vec2 uvWay = endUvs.zw - endUvs.xy;
    base *= textureGrad(baseColorTexture, endUvs.xy + place * uvWay, placePerPx.x * uvWay, placePerPx.y * uvWay);
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
    color *= lightOnSurface(normalize(mix(fromNormal, toNormal, place)));
#endif
    result = vec4(color, clamp(base.a, 0.0, 1.0));
#endif
}
