// The image-based method's second step: each pixel is looked up in the pictures of the source. MESH: at the place that a
// deformed mesh gives it; without it where its exact ray meets its picture. One of NEAREST, LINEAR, BICUBIC, MIPMAP and
// ANISOTROPIC is defined. Reading an sRGB texture gives linear light.

layout(binding = 0) uniform sampler2DArray pictures;
#ifdef MESH
layout(location = 0) in vec2 place;  // in texels
layout(location = 1) flat in int face;
#else
layout(binding = 1) uniform sampler2D places;     // xy: where the pixel's ray meets its picture, in texels; z: which; w: 0 for none
layout(binding = 2) uniform sampler2D gradients;  // how far the place moves to the next pixel and to the next row
#endif

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

#if defined(MIPMAP) || defined(ANISOTROPIC)
#define LEVELS
vec4 fromLevel(vec2 at, int picture, float texels) {
    return textureLod(pictures, vec3(at / vec2(textureSize(pictures, 0).xy), picture), log2(max(texels, 1.0)));
}

// Beyond what the last level holds a filter would take in texels from outside of the picture.
vec2 bounded(vec2 gradient) {
    float most = exp2(float(textureQueryLevels(pictures) - 1));
    return gradient * min(1.0, most / max(length(gradient), 1e-6));
}
#endif

#ifdef ANISOTROPIC
// Places side by side along the longer axis of what the pixel covers, each as wide as the shorter one (McCormack et al.,
// Feline, 1999). Drivers do the like, and differ; one of them goes astray where pixels of two pictures meet.
vec4 anisotropic(vec2 at, int picture, vec2 right, vec2 down) {
    const float MOST_PLACES = 16.0;
    vec3 square = vec3(right.x * right.x + down.x * down.x, right.y * right.y + down.y * down.y,
                       right.x * right.y + down.x * down.y);  // the map times its transpose: xx, yy, xy
    float middle = 0.5 * (square.x + square.y);
    float radius = length(vec2(0.5 * (square.x - square.y), square.z));
    float longer = sqrt(middle + radius), shorter = max(sqrt(max(middle - radius, 0.0)), 1.0);
    vec2 along = square.x > square.y ? vec2(middle + radius - square.y, square.z) : vec2(square.z, middle + radius - square.x);
    along *= longer / max(length(along), 1e-6);
    float count = clamp(ceil(longer / shorter), 1.0, MOST_PLACES);
    vec4 sum = vec4(0.0);
    for (float i = 0.5; i < count; ++i) sum += fromLevel(at + (i / count - 0.5) * along, picture, max(shorter, longer / count));
    return sum / count;
}
#endif

void main() {
#ifdef MESH
#ifdef LEVELS
    vec2 right = bounded(dFdx(place)), down = bounded(dFdy(place));
#endif
#else
    vec4 placeOfRay = texelFetch(places, ivec2(gl_FragCoord.xy), 0);
    if (placeOfRay.w == 0.0) discard;
    vec2 place = placeOfRay.xy;
    int face = int(placeOfRay.z);
#ifdef LEVELS
    vec4 gradient = texelFetch(gradients, ivec2(gl_FragCoord.xy), 0);
    vec2 right = bounded(gradient.xy), down = bounded(gradient.zw);
#endif
#endif
#if defined(BICUBIC)
    result = bicubic(place, face);
#elif defined(LINEAR)
    result = textureLod(pictures, vec3(place / vec2(textureSize(pictures, 0).xy), face), 0.0);
#elif defined(MIPMAP)
    result = fromLevel(place, face, max(length(right), length(down)));
#elif defined(ANISOTROPIC)
    result = anisotropic(place, face, right, down);
#else
    result = texelFetch(pictures, ivec3(ivec2(place), face), 0);
#endif
}
