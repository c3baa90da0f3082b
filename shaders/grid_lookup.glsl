// The nodes of the piece tree between which a sphere's lie, from a NodeGrid of renderer/node_grid.h.

#define real float
#define real2 vec2
#define real3 vec3
#include "sphere_bounds.glsl"
#include "node_grid.glsl"

layout(std430, binding = 2) readonly buffer NodeGrid {
    vec4 right, down, ahead;
    vec2 least, cellsPerUnit;
    ivec4 width;  // x
    uvec2 ranges[];
} grid;

uvec2 nodesTouched(vec3 centre, float radius) {
    BoxBounds box = sphereBoxBounds(centre, sphereRoundedOut(centre, radius), grid.right.xyz, grid.down.xyz, grid.ahead.xyz, 0.0);
    GridCells cells = gridCellsUnder(box, grid.least, grid.cellsPerUnit, grid.width.x);
    uvec2 touched = uvec2(0xffffffffu, 0u);
    for (int y = cells.first.y; y <= cells.last.y; ++y) {
        for (int x = cells.first.x; x <= cells.last.x; ++x) {
            uvec2 range = grid.ranges[cells.offset + y * cells.width + x];
            touched = uvec2(min(touched.x, range.x), max(touched.y, range.y));
        }
    }
    return touched;
}
