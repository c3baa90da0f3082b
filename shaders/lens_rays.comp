// The ray of every sample of a round lens's picture, one layer a sample: xyz is of length one, in lens axes (ahead is -z),
// and w is 1 where the lens shows something.

#define real float
#define real2 vec2
#define real3 vec3

// OpenGL promises nothing of sin and cos, and a thousandth of a radian is a pixel: their series, for 0 to half a turn.
vec2 sineCosine(float angle) {
    const float pi = 3.14159265;
    float acute = min(angle, pi - angle);
    bool swapped = acute > 0.25 * pi;
    float x = swapped ? 0.5 * pi - acute : acute, z = x * x;
    float sine = x * (1.0 - z / 6.0 * (1.0 - z / 20.0 * (1.0 - z / 42.0 * (1.0 - z / 72.0))));
    float cosine = 1.0 - z / 2.0 * (1.0 - z / 12.0 * (1.0 - z / 30.0 * (1.0 - z / 56.0)));
    vec2 both = swapped ? vec2(cosine, sine) : vec2(sine, cosine);
    return angle > 0.5 * pi ? vec2(both.x, -both.y) : both;
}
#define sin(angle) sineCosine(angle).x
#define cos(angle) sineCosine(angle).y
#include "radial.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, binding = 0) writeonly uniform image2DArray rays;
layout(location = 0) uniform float coefficients[kRadialTerms];
layout(location = 9) uniform vec2 centrePx;
layout(location = 10) uniform vec2 focalPx;
layout(location = 11) uniform float edgeRad;
layout(location = 12) uniform float edgeRadius;  // of the picture, in focal lengths
layout(location = 13) uniform vec2 offsetsPx[MOST_SAMPLES];  // from the pixel's top left corner

void main() {
    ivec3 texel = ivec3(gl_GlobalInvocationID);
    vec2 offset = (vec2(texel.xy) + offsetsPx[texel.z] - centrePx) / focalPx;
    vec3 ray = radialDirection(LENS, coefficients, vec2(offset.x, -offset.y), edgeRad);
    imageStore(rays, texel, length(offset) <= edgeRadius ? vec4(ray, 1.0) : vec4(0.0));
}
