// The image-based method's second step: each pixel looks along its exact ray into the cube map.

layout(binding = 0) uniform samplerCube cube;
layout(binding = 1) uniform sampler2D rays;  // xyz: unit ray of the pixel centre, w: 0 where there is none

layout(location = 0) out vec4 result;

void main() {
    vec4 ray = texelFetch(rays, ivec2(gl_FragCoord.xy), 0);
    if (ray.w == 0.0) discard;
    result = textureLod(cube, ray.xyz, 0.0);
}
