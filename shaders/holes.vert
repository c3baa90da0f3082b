// Tiles of the display that have pixels without an owner.

layout(std430, binding = 0) readonly buffer Tiles { ivec4 tiles[]; };  // left, top, right, bottom, pixels
layout(location = 0) uniform vec2 sizePx;

void main() {
    ivec4 tile = tiles[gl_InstanceID];
    vec2 corner = vec2((gl_VertexID & 1) == 0 ? tile.x : tile.z, (gl_VertexID & 2) == 0 ? tile.y : tile.w);
    gl_Position = vec4(2.0 * corner / sizePx - 1.0, 0.0, 1.0);
}
