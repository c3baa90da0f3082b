// Where the source is looked up, as a deformed mesh: the display in two triangles a cell.

struct Cell {
    vec4 px;  // left, top, right and bottom
    vec4 topPlaces, bottomPlaces;  // left and right, in texels
    vec4 face;  // x
};
layout(std430, binding = 0) readonly buffer Cells { Cell cells[]; };
layout(location = 0) uniform vec2 sizePx;

layout(location = 0) out vec2 place;
layout(location = 1) flat out int face;

void main() {
    // The diagonal goes from the top right to the bottom left corner.
    const uint corners[6] = uint[](0u, 1u, 2u, 2u, 1u, 3u);
    Cell cell = cells[gl_VertexID / 6];
    uint corner = corners[gl_VertexID % 6];
    bool right = (corner & 1u) != 0u, bottom = (corner & 2u) != 0u;
    vec4 places = bottom ? cell.bottomPlaces : cell.topPlaces;
    place = right ? places.zw : places.xy;
    face = int(cell.face.x);
    vec2 px = vec2(right ? cell.px.z : cell.px.x, bottom ? cell.px.w : cell.px.y);
    gl_Position = vec4(2.0 * px / sizePx - 1.0, 0.0, 1.0);
}
