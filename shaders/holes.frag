// Where nobody owns a pixel nothing is drawn: it gets the depth that nothing is in front of.

layout(binding = 1) uniform isampler2DArray owners;

void main() {
    if (texelFetch(owners, ivec3(gl_FragCoord.xy, 0), 0).r >= 0) discard;
    gl_FragDepth = 1.0;
}
