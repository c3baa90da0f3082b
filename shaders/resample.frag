// The image-based method's second step: each pixel looks its exact ray up in the pictures of the source. One of NEAREST,
// LINEAR and BICUBIC is defined. Reading an sRGB texture gives linear light.

layout(binding = 0) uniform sampler2DArray pictures;
layout(binding = 1) uniform sampler2D places;  // xy: where the pixel's ray meets its picture, in texels; z: which; w: 0 for none

layout(location = 0) out vec4 result;

#ifdef BICUBIC
// Catmull and Rom, A class of local interpolating splines, 1974: a cubic through the two middle texels of four, with the
// slopes that their neighbours give.
vec4 weightsOfFour(float t) {
    float t2 = t * t;
    float t3 = t2 * t;
    return 0.5 * vec4(2.0 * t2 - t - t3, 2.0 - 5.0 * t2 + 3.0 * t3, t + 4.0 * t2 - 3.0 * t3, t3 - t2);
}

vec4 bicubic(vec2 at, int picture) {
    vec2 corner = floor(at - 0.5);
    vec4 across = weightsOfFour(at.x - 0.5 - corner.x);
    vec4 down = weightsOfFour(at.y - 0.5 - corner.y);
    vec4 sum = vec4(0.0);
    for (int y = 0; y < 4; ++y) {
        vec4 row = vec4(0.0);
        for (int x = 0; x < 4; ++x)
            row += across[x] * texelFetch(pictures, ivec3(ivec2(corner) + ivec2(x - 1, y - 1), picture), 0);
        sum += down[y] * row;
    }
    return max(sum, vec4(0.0));  // beside what is bright it goes below black
}
#endif

void main() {
    vec4 place = texelFetch(places, ivec2(gl_FragCoord.xy), 0);
    if (place.w == 0.0) discard;
#if defined(BICUBIC)
    result = bicubic(place.xy, int(place.z));
#elif defined(LINEAR)
    result = textureLod(pictures, vec3(place.xy / vec2(textureSize(pictures, 0).xy), place.z), 0.0);
#else
    result = texelFetch(pictures, ivec3(ivec2(place.xy), int(place.z)), 0);
#endif
}
