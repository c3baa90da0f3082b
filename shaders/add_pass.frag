// Adds one pass of a frame, weighted, to the sum of all. Reading an sRGB texture gives linear light.

layout(binding = 0) uniform sampler2D pass;
layout(location = 0) uniform float weight;

layout(location = 0) out vec4 result;

void main() { result = weight * texelFetch(pass, ivec2(gl_FragCoord.xy), 0); }
